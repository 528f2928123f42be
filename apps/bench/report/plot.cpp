// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/plot.hpp"

#include "host/process/run_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

namespace tandem::bench {

namespace {

/// One line of a plot: its name in the key, the group that its style depends on, its points.
struct Line {
    std::string title, group;
    std::vector<std::pair<double, double>> points;
};

// Baselines are grey and dashed, Tandem is blue and thick; peers have colours that the colour-blind can tell apart
// (Okabe and Ito).
constexpr const char* peer_colours[] = {"#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                        "#56b4e9", "#8c6d31", "#7f3c8d"};

/// How many lines of each group a plot has so far.
struct StyleCounts {
    int baselines = 0, tandem = 0, peers = 0;
};

/// The next style of the line's group, as gnuplot's options.
std::string style_of(const Line& line, StyleCounts& used) {
    constexpr const char* greys[] = {"#999999", "#555555", "#bbbbbb"};
    constexpr const char* blues[] = {"#0072b2", "#3fa0e0", "#003f66"};
    if (line.group == "baseline")
        return fmt::format("lc rgb '{}' lw 2 dt (8,4)", greys[used.baselines++ % 3]);
    if (line.group == "tandem") return fmt::format("lc rgb '{}' lw 3.5", blues[used.tandem++ % 3]);
    return fmt::format("lc rgb '{}' lw 1.8", peer_colours[used.peers++ % std::size(peer_colours)]);
}

/// Runs gnuplot on a script with the data inside. `with`: gnuplot's plotting style. SVG elements of several plots
/// stand in one page, so each has a name of its own.
Plot draw(const std::string& title, const std::string& axes, const char* with,
          const std::vector<Line>& lines) {
    static int number = 0;
    std::string script = fmt::format(
        "set terminal svg size 900,460 dynamic font 'Helvetica,13' background rgb 'white' name 'plot{}'\n"
        "set grid lt 1 lw 1 lc rgb '#e4e4e4'\nset border 3 lc rgb '#444444'\nset tics nomirror\n"
        "set key outside right top font ',11' samplen 2\n{}",
        number++, axes);
    // The data as here-documents: one process, no files.
    for (std::size_t i = 0; i < lines.size(); ++i) {
        script += fmt::format("$data{} << EOD\n", i);
        for (const auto& [x, y] : lines[i].points) script += fmt::format("{:.9g} {:.9g}\n", x, y);
        script += "EOD\n";
    }
    StyleCounts used;
    for (std::size_t i = 0; i < lines.size(); ++i)
        script += fmt::format("{} $data{} with {} {} title '{}' noenhanced", i == 0 ? "plot" : ",", i, with,
                              style_of(lines[i], used), lines[i].title);
    process::CommandOptions options;
    options.input = script + "\n";
    const auto result = process::run_command({"gnuplot", "-"}, options);
    const std::size_t begin = result.output.find("<svg");
    if (!result.succeeded() || begin == std::string::npos)
        throw std::runtime_error(
            fmt::format("gnuplot could not draw '{}': {}; install gnuplot-nox", title, result.failure()));
    return {title, result.output.substr(begin)};
}

/// The name of a row's line in the key.
std::string label_of(const Row& row) {
    std::string label = row.subject + " " + row.wake;
    if (!row.detail.empty()) label += " " + row.detail;
    return label;
}

/// Whether a row belongs to a plot.
using RowFilter = std::function<bool(const Row&)>;

// Written out, since gnuplot's own labels of a logarithmic axis are powers of ten without a unit.
constexpr const char* time_axis = "set logscale xy\nset ylabel 'time'\nset ytics ('10 ns' 10, '100 ns' 100, "
                                  "'1 us' 1e3, '10 us' 1e4, '100 us' 1e5, "
                                  "'1 ms' 1e6, '10 ms' 1e7, '100 ms' 1e8)\n";

/// A percentile plot: each step to the right is ten times rarer. The x axis is 1 / (1 - share), logarithmic.
void add_distribution(std::vector<Plot>& plots, const Report& report, const std::string& title,
                      const RowFilter& filter) {
    std::vector<Line> lines;
    for (const Row& row : report.rows) {
        if (!row.skipped.empty() || !row.is_latency() || !row.has_two_processes() || !filter(row)) continue;
        Line line{label_of(row), row.group, {}};
        for (const CurvePoint& point : row.summary.curve)
            line.points.emplace_back(1 / (1 - point.share), point.value);
        lines.push_back(std::move(line));
    }
    if (lines.empty()) return;
    plots.push_back(draw(title,
                         std::string(time_axis) +
                             "set xlabel 'percentile'\nset xtics ('0' 1, '50' 2, '90' 10, '99' "
                             "100, '99.9' 1000, '99.99' 10000, '99.999' 100000)\nset xrange [1:]\n",
                         "lines", lines));
}

constexpr const char* size_axis =
    "set logscale xy\nset xlabel 'bytes'\nset xtics ('8' 8, '64' 64, '1 Ki' 1024, '64 Ki' "
    "65536, '1 Mi' 1048576, '6 Mi' 6291456)\nset xrange [6:9000000]\n";

/// One line for each subject and detail, one point for each size.
void add_by_size(std::vector<Plot>& plots, const Report& report, const std::string& title,
                 const std::string& axis, const RowFilter& filter,
                 const std::function<double(const Row&)>& value) {
    std::map<std::string, Line> by_label;
    for (const Row& row : report.rows) {
        if (!row.skipped.empty() || row.conditions != "normal" || row.placement != "processes" ||
            !filter(row))
            continue;
        Line& line = by_label[row.group + " " + row.subject + " " + row.detail];
        line.title = row.subject + (row.detail.empty() ? "" : " " + row.detail);
        line.group = row.group;
        line.points.emplace_back(static_cast<double>(row.bytes), value(row));
    }
    std::vector<Line> lines;
    for (auto& [label, line] : by_label) {
        // Small messages are sent in one way, large ones in several ("loan", "copy"): each line of the latter
        // begins with the points of the small ones, which have no line of their own.
        const std::string plain = label.substr(0, label.rfind(' ') + 1);
        const auto small = by_label.find(plain);
        if (label != plain && small != by_label.end())
            line.points.insert(line.points.end(), small->second.points.begin(), small->second.points.end());
        else if (const auto next = by_label.upper_bound(plain);
                 next != by_label.end() && next->first.rfind(plain, 0) == 0)
            continue; // its points are part of the lines that follow
        std::sort(line.points.begin(), line.points.end());
        lines.push_back(std::move(line));
    }
    if (lines.empty()) return;
    plots.push_back(draw(title, size_axis + axis, "linespoints pt 7 ps 0.6", lines));
}

/// The 64-byte one-way rows, and the cache line as their lower limit.
RowFilter one_way(const std::string& conditions, bool asleep) {
    return [=](const Row& row) {
        return row.operation == "one-way" && row.conditions == conditions &&
               (row.bytes == 64 || row.subject == "cache-line") && (row.wake == "blocking") == asleep;
    };
}

} // namespace

std::vector<Plot> draw_plots(const Report& report) {
    std::vector<Plot> plots;
    add_distribution(plots, report, "One way, 64 B, reader awake", one_way("normal", false));
    for (const char* conditions : {"normal", "low-latency-idle", "same-core"})
        add_distribution(plots, report, std::string("One way, 64 B, reader asleep, ") + conditions,
                         one_way(conditions, true));
    add_distribution(plots, report, "One way, 64 B, loaded machine", [](const Row& row) {
        return row.operation == "one-way" && row.bytes == 64 && row.conditions == "loaded";
    });
    add_distribution(plots, report, "Call, 64 B there and back",
                     [](const Row& row) { return row.operation == "call" && row.conditions == "normal"; });
    add_distribution(plots, report, "Round trip due every millisecond, from when it was due",
                     [](const Row& row) { return row.operation == "paced"; });
    add_by_size(
        plots, report, "One way by size, polling, p50", time_axis,
        [](const Row& row) {
            return row.operation == "one-way" && row.wake == "spin" && row.group != "peer";
        },
        [](const Row& row) { return row.summary.p50; });
    add_by_size(
        plots, report, "Throughput by size", "set ylabel 'GB/s'\n",
        [](const Row& row) { return row.operation == "stream" && row.bytes > 0; },
        [](const Row& row) {
            return row.unit == "GB/s" ? row.summary.p50
                                      : row.summary.p50 * static_cast<double>(row.bytes) / 1e3;
        });
    return plots;
}

} // namespace tandem::bench
