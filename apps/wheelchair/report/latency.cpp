// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/report/latency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace tandem::wheelchair {

namespace {
constexpr std::size_t table_size = 100;
constexpr std::size_t start_ticks = 100; // one second
constexpr double stopping_s = 1.0;       // hosts stop one after the other, at most for this time

/// A thread that wakes on an idle core waits for some microseconds. Returns false for NaN.
bool is_disturbed(double core_taken) {
    constexpr double long_enough = 20e-6;
    return core_taken > long_enough;
}
} // namespace

Statistics statistics(const std::vector<double>& values) {
    if (values.empty()) return {};
    Statistics s;
    s.samples = values.size();
    s.average = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(s.samples);
    double squares = 0.0;
    for (double v : values) squares += (v - s.average) * (v - s.average);
    if (s.samples > 1) s.deviation = std::sqrt(squares / static_cast<double>(s.samples - 1));
    const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
    s.min = *smallest;
    s.max = *largest;
    return s;
}

double percentile(std::vector<double> values, double fraction) {
    if (values.empty()) return 0.0;
    // Nearest rank, so that the result is one of the values.
    const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, values.size()) - 1);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

std::vector<LatencySample> latencies(const std::vector<JoystickRecord>& joystick,
                                     const std::vector<ControlRecord>& control) {
    std::unordered_map<double, double> sender_taken; // by stamp
    for (const JoystickRecord& r : joystick) sender_taken[r.stamp] = r.core_taken;
    std::vector<LatencySample> out;
    for (const ControlRecord& r : control) {
        if (r.references_received <= 0) continue;
        const auto sender = sender_taken.find(r.reference_stamp);
        const bool disturbed =
            is_disturbed(r.core_taken) || (sender != sender_taken.end() && is_disturbed(sender->second));
        out.push_back({(r.reference_read_at - r.reference_stamp) * 1e6, disturbed});
    }
    return out;
}

std::vector<double> values_us(const std::vector<LatencySample>& samples, Samples which) {
    std::vector<double> out;
    for (const LatencySample& s : samples)
        if (which == Samples::all || !s.disturbed) out.push_back(s.us);
    return out;
}

std::vector<LatencySample> without_start(const std::vector<LatencySample>& samples) {
    const std::size_t first = samples.size() >= start_ticks + table_size ? start_ticks : 0;
    return {samples.begin() + static_cast<std::ptrdiff_t>(first), samples.end()};
}

std::vector<LatencySample> table_samples(const std::vector<LatencySample>& samples) {
    auto table = without_start(samples);
    table.resize(std::min(table.size(), table_size));
    return table;
}

SampleCount count_samples(const std::vector<JoystickRecord>& joystick,
                          const std::vector<ControlRecord>& control) {
    SampleCount count;
    double first = 0, last = 0; // stamps of the oldest and the newest received reference
    for (const ControlRecord& r : control) {
        if (r.references_received <= 0) continue;
        if (count.received == 0) first = r.reference_stamp;
        last = r.reference_stamp;
        // Only the newest stamp of several references in one tick is recorded. The window starts with the first
        // recorded stamp, so older references of that tick are not in it.
        count.received += count.received == 0 ? 1 : std::lround(r.references_received);
    }
    if (count.received == 0) return count;
    const auto is_expected = [&](const JoystickRecord& r) {
        return r.stamp >= first && (r.stamp <= last || r.at < control.back().at - stopping_s);
    };
    for (const JoystickRecord& r : joystick)
        if (r.sent > 0 && is_expected(r)) ++count.sent;
    count.lost = count.sent - count.received;
    return count;
}

namespace {

std::string percentiles(const std::vector<double>& us) {
    if (us.empty()) return fmt::format("{:<39}", "no sample");
    return fmt::format("{:9.2f} {:9.2f} {:9.2f} {:9.2f}", percentile(us, 0.5), percentile(us, 0.99),
                       percentile(us, 0.999), percentile(us, 1.0));
}

/// With different numbers of samples, the heading shows the largest.
std::string table_1(const std::vector<LatencyRow>& rows, Samples which) {
    std::size_t sampled = 0;
    std::string lines;
    for (const LatencyRow& r : rows) {
        const Statistics s = statistics(values_us(table_samples(r.latencies), which));
        sampled = std::max(sampled, s.samples);
        if (s.samples == 0) {
            lines += fmt::format("  {:<8} no sample\n", r.configuration);
            continue;
        }
        lines += fmt::format("  {:<8} {:9.2f} {:9.2f} {:9.2f} {:9.2f}\n", r.configuration, s.average,
                             s.deviation, s.min, s.max);
    }
    return fmt::format("Table 1. Joystick send -> control receive, {} samples [us]\n"
                       "  {:<8} {:>9} {:>9} {:>9} {:>9}\n{}",
                       sampled, "", "average", "std.dev.", "min", "max", lines);
}

std::string after_start(const std::vector<LatencyRow>& rows) {
    std::string out = fmt::format("After the first second [us]; references of the whole run\n  {:<8} {:>9} "
                                  "{:>9} {:>9} {:>9} {:>8} {:>9} {:>6}\n",
                                  "", "p50", "p99", "p99.9", "max", "sent", "received", "lost");
    for (const LatencyRow& r : rows)
        out += fmt::format("  {:<8} {} {:>8} {:>9} {:>6}\n", r.configuration,
                           percentiles(values_us(without_start(r.latencies))), r.samples.sent,
                           r.samples.received, r.samples.lost);
    return out;
}

std::string without_disturbed(const std::vector<LatencyRow>& rows) {
    std::string out = "Without the samples in whose tick a component's core was taken for over 20 us\n";
    out += table_1(rows, Samples::undisturbed);
    out += fmt::format("After the first second [us]\n  {:<8} {:>9} {:>9} {:>9} {:>9} {:>8} {:>9}\n", "",
                       "p50", "p99", "p99.9", "max", "samples", "disturbed");
    for (const LatencyRow& r : rows) {
        const auto samples = without_start(r.latencies);
        const auto kept = values_us(samples, Samples::undisturbed);
        out += fmt::format("  {:<8} {} {:>8} {:>9}\n", r.configuration, percentiles(kept), kept.size(),
                           samples.size() - kept.size());
    }
    return out;
}

} // namespace

std::string latency_tables(const std::vector<LatencyRow>& rows) {
    std::string out = table_1(rows, Samples::all) + after_start(rows);
    const auto median = [](const LatencyRow& r) {
        return percentile(values_us(without_start(r.latencies)), 0.5);
    };
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
        if (rows[i].latencies.empty() || rows.back().latencies.empty()) continue;
        out += fmt::format("  p50 of {} minus p50 of {}: {:+.2f} us\n", rows.back().configuration,
                           rows[i].configuration, median(rows.back()) - median(rows[i]));
    }
    const auto has_disturbed = [](const LatencyRow& r) {
        const auto samples = without_start(r.latencies);
        return std::any_of(samples.begin(), samples.end(), [](auto s) { return s.disturbed; });
    };
    if (std::any_of(rows.begin(), rows.end(), has_disturbed)) out += without_disturbed(rows);
    return out;
}

} // namespace tandem::wheelchair
