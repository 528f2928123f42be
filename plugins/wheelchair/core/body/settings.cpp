// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/body/settings.hpp"

#include <charconv>

#include "plugins/wheelchair/core/plant/parameters.hpp"

namespace tandem::wheelchair {

namespace {

// Parses the parameter `clock`.
ClockKind clock_kind(const std::string& clock) {
    if (clock.empty() || clock == "monotonic") return ClockKind::monotonic;
    if (clock == "simulated") return ClockKind::simulated;
    if (clock == "arrival") return ClockKind::arrival;
    throw InputError("parameter clock is '" + clock + "'; expected monotonic, simulated or arrival");
}

/// Parses the parameter `poll_us`. It must be shorter than a tick, so that the component can keep its period.
double poll_seconds(const std::string& text) {
    if (text.empty()) return 0.0;
    double us = -1.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), us);
    const bool whole = error == std::errc{} && end == text.data() + text.size();
    if (!whole || !(us >= 0.0) || us >= 1e6 * tick_seconds)
        throw InputError("parameter poll_us is '" + text + "'; expected microseconds from 0 to below 10000");
    return us * 1e-6;
}

} // namespace

Settings read_settings(const RawSettings& texts) {
    return {load_scenario(texts.scenario, texts.joystick_file), clock_kind(texts.clock),
            poll_seconds(texts.poll_us), texts.trace, ControlParameters{}.ratio_gain};
}

double read_ratio_gain(const std::string& text) {
    if (text.empty()) return ControlParameters{}.ratio_gain;
    double gain = -1.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), gain);
    const bool whole = error == std::errc{} && end == text.data() + text.size();
    if (!whole || !(gain >= 0.0) || gain > 1e3)
        throw InputError("parameter ratio_gain is '" + text + "'; expected V s/rad from 0 to 1000");
    return gain;
}

} // namespace tandem::wheelchair
