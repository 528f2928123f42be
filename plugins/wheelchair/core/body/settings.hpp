// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plugins/wheelchair/core/body/clock.hpp"
#include "plugins/wheelchair/core/plant/parameters.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

/// The parameters of a component as texts from profiles (OPRoS) or rtc.conf (RTM). Empty: the default. Each component
/// has only some of them.
struct RawSettings {
    std::string scenario{};      // name, default step20
    std::string joystick_file{}; // CSV with stick positions, default none
    std::string clock{};         // monotonic (default) | simulated | arrival
    std::string poll_us{};       // how long ControlComp polls for a reference in each tick, default 0
    std::string trace{};         // trace file to write, default none
};

/// The validated parameters.
struct Settings {
    Scenario scenario;
    ClockKind clock = ClockKind::monotonic;
    double poll_seconds = 0.0;
    std::string trace;
    double ratio_gain = ControlParameters{}.ratio_gain;
};

/// Throws InputError with the parameter and its allowed values.
Settings read_settings(const RawSettings& texts);
/// Parses ControlComp's parameter of this name, V s/rad; empty: the default. Throws InputError.
double read_ratio_gain(const std::string& text);

} // namespace tandem::wheelchair
