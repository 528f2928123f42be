// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/report/latency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tandem::wheelchair {

namespace {
constexpr std::size_t table_size = 100;
constexpr std::size_t skipped = 100; // ticks; during the first second the hosts are still starting
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

std::vector<double> latencies_us(const std::vector<ControlRecord>& control) {
    std::vector<double> out;
    for (const ControlRecord& r : control)
        if (r.references_received > 0) out.push_back((r.reference_read_at - r.reference_stamp) * 1e6);
    return out;
}

std::vector<double> table_samples(const std::vector<double>& latencies) {
    // A shorter run keeps its first samples.
    const std::size_t first = latencies.size() >= skipped + table_size ? skipped : 0;
    const std::size_t last = std::min(first + table_size, latencies.size());
    return {latencies.begin() + static_cast<std::ptrdiff_t>(first),
            latencies.begin() + static_cast<std::ptrdiff_t>(last)};
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
    for (const JoystickRecord& r : joystick)
        if (r.sent > 0 && r.stamp >= first && r.stamp <= last) ++count.sent;
    count.lost = count.sent - count.received;
    return count;
}

std::string latency_tables(const std::vector<LatencyRow>& rows) {
    const auto sampled = rows.empty() ? 0 : table_samples(rows.front().latencies).size();
    std::string out = fmt::format("Table 1. Joystick send -> control receive, {} samples [us]\n"
                                  "  {:<8} {:>9} {:>9} {:>9} {:>9}\n",
                                  sampled, "", "average", "std.dev.", "min", "max");
    for (const LatencyRow& r : rows) {
        const Statistics s = statistics(table_samples(r.latencies));
        out += fmt::format("  {:<8} {:9.2f} {:9.2f} {:9.2f} {:9.2f}\n", r.configuration, s.average,
                           s.deviation, s.min, s.max);
    }
    out += fmt::format("Whole run [us]\n  {:<8} {:>9} {:>9} {:>9} {:>9} {:>8} {:>9} {:>6}\n", "", "p50",
                       "p99", "p99.9", "max", "sent", "received", "lost");
    for (const LatencyRow& r : rows) {
        out += fmt::format("  {:<8} {:9.2f} {:9.2f} {:9.2f} {:9.2f} {:>8} {:>9} {:>6}\n", r.configuration,
                           percentile(r.latencies, 0.5), percentile(r.latencies, 0.99),
                           percentile(r.latencies, 0.999), percentile(r.latencies, 1.0), r.samples.sent,
                           r.samples.received, r.samples.lost);
    }
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
        out += fmt::format("  p50 of {} minus p50 of {}: {:+.2f} us\n", rows.back().configuration,
                           rows[i].configuration,
                           percentile(rows.back().latencies, 0.5) - percentile(rows[i].latencies, 0.5));
    return out;
}

} // namespace tandem::wheelchair
