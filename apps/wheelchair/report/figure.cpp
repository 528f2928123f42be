// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/report/figure.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "host/process/output_file.hpp"
#include "host/process/run_command.hpp"
#include "host/text/quote.hpp"

namespace tandem::wheelchair {

namespace {

namespace fs = std::filesystem;

// Dark, middle and light, each with its own dash pattern, for print and for colour-blind readers.
constexpr const char* styles =
    "set style line 1 lc rgb '#0072b2' lw 2\n"
    "set style line 2 lc rgb '#d55e00' lw 2 dt (12,4)\n"
    "set style line 3 lc rgb '#009e73' lw 2 dt (3,3)\n"
    "set style line 12 lc rgb '#d55e00' lw 1\nset style line 13 lc rgb '#009e73' lw 1\n"
    "set style line 9 lc rgb '#888888' lw 1.5 dt (6,4)\n"
    "set grid lt 1 lw 1 lc rgb '#dddddd'\nset border lc rgb '#444444'\n"
    "set key top left opaque font ',11' samplen 3\n"
    "set lmargin at screen 0.10\nset rmargin at screen 0.97\n";

// PNG for slides, SVG for pages. The white background is readable in dark mode, too.
std::string terminal(const fs::path& path, int height) {
    const bool svg = path.extension() == ".svg";
    const std::string kind = svg ? "svg size 900,{} font 'Helvetica,13' background rgb 'white'"
                                 : "pngcairo size 900,{} font 'Helvetica,11' background rgb 'white'";
    return "set terminal " + fmt::format(fmt::runtime(kind), height) + "\n";
}

/// Returns a named block of inline data: time and the given columns.
std::string data(const std::string& name, const std::vector<Row>& rows,
                 std::initializer_list<double Row::*> columns) {
    std::string out = "$" + name + " << EOD\n";
    for (const Row& r : rows) {
        out += fmt::format("{:.6g}", r.t);
        for (auto column : columns) out += fmt::format(" {:.7g}", r.*column);
        out += '\n';
    }
    return out + "EOD\n";
}

// gnuplot reads its script from standard input and writes the figure to standard output, so it never sees a file name.
process::CommandResult run_gnuplot(const process::CommandOptions& options) {
    try {
        return process::run_command({"gnuplot", "-"}, options);
    } catch (const std::system_error& error) {
        throw InputError(std::string(error.what()) + "; install gnuplot-nox");
    }
}

void gnuplot(const fs::path& figure, const std::string& script) {
    process::CommandOptions options;
    options.input = script;
    const auto result = run_gnuplot(options);
    if (!result.succeeded())
        throw InputError(fmt::format("gnuplot cannot draw {}: {}; install gnuplot-nox", figure.string(),
                                     result.failure()));
    process::write_output(figure, result.output);
}

// Covers the whole run, so that figures of the same scenario have the same axis.
std::string time_axis(const std::vector<Row>& rows) {
    const double end = rows.empty() ? 1.0 : rows.back().t;
    return fmt::format("set xrange [0:{:g}]\n", end);
}

// Two plots, one above the other: the steering angles, and their differences from the first run.
std::string comparison_script(const fs::path& path, const std::string& title,
                              const std::vector<std::pair<std::string, std::vector<Row>>>& runs) {
    std::string script = terminal(path, 720) + styles;
    const auto& first = runs.front();
    for (std::size_t i = 0; i < runs.size(); ++i) {
        auto rows = runs[i].second;
        script +=
            data(fmt::format("run{}", i), rows, {&Row::steering_measured_deg, &Row::reference_direction_deg});
        // Runs can have different lengths; differences end with the shorter one.
        rows.resize(std::min(rows.size(), first.second.size()));
        for (std::size_t n = 0; n < rows.size(); ++n)
            rows[n].steering_measured_deg -= first.second[n].steering_measured_deg;
        script += data(fmt::format("off{}", i), rows, {&Row::steering_measured_deg});
    }
    script += time_axis(first.second) + "set multiplot\n";
    script += fmt::format("set title {} noenhanced\nset tmargin at screen 0.94\nset bmargin at screen 0.40\n",
                          text::quote_gnuplot(title));
    script += "set offsets 0,0,graph 0.05,graph 0.05\nset ylabel 'steering angle, measured [deg]'\nset "
              "format x ''\nplot $run0 using 1:3 with steps "
              "ls 9 title "
              "'reference'";
    for (std::size_t i = 0; i < runs.size(); ++i)
        script += fmt::format(", $run{} using 1:2 with lines ls {} title {}", i, i + 1,
                              text::quote_gnuplot(runs[i].first));
    script += "\nunset title\nset format x '%g'\nset tmargin at screen 0.36\nset bmargin at screen 0.09\n"
              "set xlabel 'time [s]'\n";
    script += fmt::format("set ylabel {}\nset key top right horizontal\n",
                          text::quote_gnuplot("difference to " + first.first + " [deg]"));
    // Lock-step runs are identical, and gnuplot cannot scale an empty range.
    script += "set offsets 0,0,graph 0.15,graph 0.05\n"
              "stats [*:*] [*:*] $off1 using 2 nooutput\n"
              "if (STATS_min == STATS_max) { set yrange [-0.1:0.1] } else { set autoscale y }\nplot ";
    for (std::size_t i = 1; i < runs.size(); ++i)
        script += fmt::format("{}$off{} using 1:2 with lines ls {} title {}", i > 1 ? ", " : "", i, i + 11,
                              text::quote_gnuplot(runs[i].first));
    return script + "\nunset multiplot\n";
}

// Three plots, one above the other, with a common time axis.
std::string run_script(const fs::path& path, const std::string& title, const std::vector<Row>& rows) {
    std::string script = terminal(path, 900) + styles + time_axis(rows);
    script +=
        data("run", rows,
             {&Row::reference_direction_deg, &Row::steering_measured_deg, &Row::steering_true_deg,
              &Row::wheel_left_measured, &Row::wheel_right_measured, &Row::volts_left, &Row::volts_right});
    script += "set multiplot\nset format x ''\nset offsets 0,0,graph 0.1,graph 0.05\n";
    script += fmt::format("set title {} noenhanced\nset tmargin at screen 0.95\nset bmargin at screen 0.67\n",
                          text::quote_gnuplot(title));
    script += "set ylabel 'steering angle [deg]'\nplot $run using 1:2 with steps ls 9 title 'reference', "
              "'' using 1:3 with lines ls 2 title 'measured', '' using 1:4 with lines ls 1 title 'true'\n";
    script +=
        "unset title\nset tmargin at screen 0.64\nset bmargin at screen 0.37\nset ylabel 'wheel speed "
        "[rad/s]'\n"
        "plot $run using 1:5 with lines ls 1 title 'left', '' using 1:6 with lines ls 2 title 'right'\n";
    script +=
        "set format x '%g'\nset xlabel 'time [s]'\nset tmargin at screen 0.34\nset bmargin at screen 0.07\n"
        "set ylabel 'motor voltage [V]'\n"
        "plot $run using 1:7 with steps ls 1 title 'left', '' using 1:8 with steps ls 2 title 'right'\n";
    return script + "unset multiplot\n";
}

} // namespace

void check_figure_path(const std::string& path) {
    const auto ending = fs::path(path).extension();
    if (ending != ".svg" && ending != ".png")
        throw InputError(path + ": expected a file name that ends in .svg or .png");
}

void draw_run(const std::string& path, const std::string& title, const std::vector<Row>& rows) {
    check_figure_path(path);
    gnuplot(path, run_script(path, title, rows));
}

void draw_comparison(const std::string& path, const std::string& title,
                     const std::vector<std::pair<std::string, std::vector<Row>>>& runs) {
    check_figure_path(path);
    for (const char* ending : {".svg", ".png"}) {
        const auto figure = fs::path(path).replace_extension(ending);
        gnuplot(figure, comparison_script(figure, title, runs));
    }
}

} // namespace tandem::wheelchair
