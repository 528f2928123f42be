// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tandem::bench {

std::string figure_text(double value) {
    if (value == 0) return "0";
    // Four significant digits: 123.4 has one after the point, 0.01234 has five, cut to three.
    const int digits = std::max(0, 3 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
    return fmt::format("{:.{}f}", value, std::min(digits, 3));
}

std::string measurements_text(const std::vector<double>& values) {
    std::string out = fmt::format("measured {} times:", values.size());
    for (double value : values) out += std::isfinite(value) ? " " + figure_text(value) : " -";
    return out;
}

namespace {

/// One line. The upper percentiles of a rate are left out, because they are those of its best windows.
std::string line_of(const Row& row, std::size_t width) {
    const Summary& s = row.summary;
    const auto tail = [&](double value) { return row.is_latency() ? figure_text(value) : std::string("-"); };
    return fmt::format(
        "{:<{}} {:<5} {:>5} {:>8} {:>9} {:>9} {:>9} {:>10} {:>11} {}\n", row.id, width, row.unit, row.cores,
        s.samples, figure_text(s.p50), tail(s.p90), tail(s.p99), tail(s.p999), figure_text(s.max),
        row.conditions +
            (row.tick_counts ? fmt::format(" {} overruns, {} periods skipped", row.tick_counts->overruns,
                                           row.tick_counts->skipped)
                             : "") +
            (row.window_counts
                 ? fmt::format(" quartiles {:.3f} .. {:.3f}, floor {:.0f} ns, {} of {} windows dropped",
                               s.p25, s.p75, row.window_counts->floor_ns, row.window_counts->dropped,
                               row.window_counts->kept + row.window_counts->dropped)
                 : "") +
            (row.measured_again > 0 ? ", " + measurements_text(row.runs) : "") +
            (row.is_disturbed()
                 ? fmt::format(" DISTURBED: others used {:.0f} % of the machine", row.foreign_cpu_share * 100)
                 : ""));
}

} // namespace

/// The first column is as wide as the longest name, so that the other columns are aligned.
std::string table_text(const Report& report) {
    const Machine& m = report.machine;
    std::size_t width = 4;
    for (const Row& row : report.rows)
        if (row.skipped.empty()) width = std::max(width, row.id.size());
    std::string out =
        fmt::format("{}, {} cores, {}\nclock {}, {}\n\n", m.processor, m.cores, m.kernel, m.clock, m.date);
    out += fmt::format("{:<{}} {:<5} {:>5} {:>8} {:>9} {:>9} {:>9} {:>10} {:>11} {}\n", "case", width, "unit",
                       "cores", "samples", "p50", "p90", "p99", "p99.9", "max", "conditions");
    for (const Row& row : report.rows)
        if (row.skipped.empty()) out += line_of(row, width);
    // Repeated in one line, because the mark of a single row is easily overlooked.
    const auto disturbed = std::count_if(report.rows.begin(), report.rows.end(),
                                         [](const Row& row) { return row.is_disturbed(); });
    if (disturbed > 0)
        out += fmt::format(
            "{} of {} rows were disturbed: other processes used more than 2 % of the machine during a run\n",
            disturbed, report.rows.size());
    for (const Row& row : report.rows)
        if (!row.skipped.empty()) out += fmt::format("skipped {}: {}\n", row.id, row.skipped);
    return out;
}

std::string path_text(const Report& report, bool functions) {
    std::string out;
    for (const Row& row : report.rows) {
        if (!row.path_counts) continue;
        const PathCounts& counts = *row.path_counts;
        if (out.empty() || functions)
            out +=
                fmt::format("\n{:<44} {:>12} {:>10} {:>10} {:>7} {:>6} {:>12}\n", "one warm message or call",
                            "instructions", "code lines", "code pages", "mallocs", "locked", "system calls");
        out += fmt::format("{:<44} {:>12} {:>10} {:>10} {:>7} {:>6} {:>12}\n", row.id, counts.instructions,
                           counts.code_lines, counts.code_pages, counts.allocations, counts.locked,
                           counts.system_calls);
        if (functions)
            for (const std::string& line : row.path_functions) out += "  " + line + "\n";
    }
    return out;
}

} // namespace tandem::bench
