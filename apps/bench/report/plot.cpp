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

struct Line {
    std::string title, group;
    std::vector<std::pair<double, double>> points;
};

// The floor is grey and dashed, ours thick; peers by colours that the colour-blind can tell apart.
constexpr const char* peer_colours[] = {"#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                        "#56b4e9", "#8c6d31", "#7f3c8d"};

std::string style_of(const Line& line, int& floors, int& ours, int& peers) {
    constexpr const char* floor_greys[] = {"#999999", "#555555", "#bbbbbb"};
    constexpr const char* our_blues[] = {"#0072b2", "#3fa0e0", "#003f66"};
    if (line.group == "baseline") return fmt::format("lc rgb '{}' lw 2 dt (8,4)", floor_greys[floors++ % 3]);
    if (line.group == "tandem") return fmt::format("lc rgb '{}' lw 3.5", our_blues[ours++ % 3]);
    return fmt::format("lc rgb '{}' lw 1.8", peer_colours[peers++ % std::size(peer_colours)]);
}

Plot draw(const std::string& title, const std::string& axes, const char* with,
          const std::vector<Line>& lines) {
    static int number = 0;
    std::string script = fmt::format(
        "set terminal svg size 900,460 dynamic font 'Helvetica,13' background rgb 'white' name 'plot{}'\n"
        "set grid lt 1 lw 1 lc rgb '#e4e4e4'\nset border 3 lc rgb '#444444'\nset tics nomirror\n"
        "set key outside right top font ',11' samplen 2\n{}",
        number++, axes);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        script += fmt::format("$data{} << EOD\n", i);
        for (const auto& [x, y] : lines[i].points) script += fmt::format("{:.9g} {:.9g}\n", x, y);
        script += "EOD\n";
    }
    int floors = 0, ours = 0, peers = 0;
    for (std::size_t i = 0; i < lines.size(); ++i)
        script += fmt::format("{} $data{} with {} {} title '{}' noenhanced", i == 0 ? "plot" : ",", i, with,
                              style_of(lines[i], floors, ours, peers), lines[i].title);
    process::CommandOptions options;
    options.input = script + "\n";
    const auto result = process::run_command({"gnuplot", "-"}, options);
    const std::size_t begin = result.output.find("<svg");
    if (!result.succeeded() || begin == std::string::npos)
        throw std::runtime_error(
            fmt::format("gnuplot could not draw '{}': {}; install gnuplot-nox", title, result.failure()));
    return {title, result.output.substr(begin)};
}

std::string label_of(const Row& row) {
    std::string label = row.subject + " " + row.wake;
    if (!row.detail.empty()) label += " " + row.detail;
    return label;
}

using RowFilter = std::function<bool(const Row&)>;

constexpr const char* time_axis = "set logscale xy\nset ylabel 'time'\nset ytics ('10 ns' 10, '100 ns' 100, "
                                  "'1 us' 1e3, '10 us' 1e4, '100 us' 1e5, "
                                  "'1 ms' 1e6, '10 ms' 1e7, '100 ms' 1e8)\n";

/// Percentile plot: each step to the right is ten times rarer.
void add_distribution(std::vector<Plot>& plots, const Report& report, const std::string& title,
                      const RowFilter& filter) {
    std::vector<Line> lines;
    for (const Row& row : report.rows) {
        if (!row.skipped.empty() || !row.latency() || row.placement != "processes" || !filter(row)) continue;
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

/// One line per who and how, one point per size.
void add_by_size(std::vector<Plot>& plots, const Report& report, const std::string& title,
                 const std::string& axis, const RowFilter& filter,
                 const std::function<double(const Row&)>& value) {
    std::map<std::string, Line> by_label;
    for (const Row& row : report.rows) {
        if (!row.skipped.empty() || row.regime != "normal" || row.placement != "processes" || !filter(row))
            continue;
        Line& line = by_label[row.group + " " + row.subject + " " + row.detail];
        line.title = row.subject + (row.detail.empty() ? "" : " " + row.detail);
        line.group = row.group;
        line.points.emplace_back(static_cast<double>(row.bytes), value(row));
    }
    std::vector<Line> lines;
    for (auto& [label, line] : by_label) {
        // Small messages have one way of being sent, large ones several: the lines begin in one point.
        const std::string plain = label.substr(0, label.rfind(' ') + 1);
        const auto small = by_label.find(plain);
        if (label != plain && small != by_label.end())
            line.points.insert(line.points.end(), small->second.points.begin(), small->second.points.end());
        else if (const auto next = by_label.upper_bound(plain);
                 next != by_label.end() && next->first.rfind(plain, 0) == 0)
            continue; // part of the next one
        std::sort(line.points.begin(), line.points.end());
        lines.push_back(std::move(line));
    }
    if (lines.empty()) return;
    plots.push_back(draw(title, size_axis + axis, "linespoints pt 7 ps 0.6", lines));
}

RowFilter one_way(const std::string& regime, bool asleep) {
    return [=](const Row& row) {
        return row.operation == "one-way" && row.regime == regime &&
               (row.bytes == 64 || row.subject == "cache-line") && (row.wake == "blocking") == asleep;
    };
}

} // namespace

std::vector<Plot> draw_plots(const Report& report) {
    std::vector<Plot> plots;
    add_distribution(plots, report, "One way, 64 B, reader awake", one_way("normal", false));
    for (const char* regime : {"normal", "low-latency-idle", "same-core"})
        add_distribution(plots, report, std::string("One way, 64 B, reader asleep, ") + regime,
                         one_way(regime, true));
    add_distribution(plots, report, "One way, 64 B, loaded machine", [](const Row& row) {
        return row.operation == "one-way" && row.bytes == 64 && row.regime == "loaded";
    });
    add_distribution(plots, report, "Call, 64 B there and back",
                     [](const Row& row) { return row.operation == "call" && row.regime == "normal"; });
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
