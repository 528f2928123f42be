// SPDX-License-Identifier: Apache-2.0
// wheelchair: the paper's experiment. See --help.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>

#include "apps/hosts/supervisor.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/wheelchair/options.hpp"
#include "apps/wheelchair/report/figure.hpp"
#include "apps/wheelchair/report/report.hpp"
#include "apps/wheelchair/run/live_drive.hpp"
#include "host/log/output_failures.hpp"
#include "host/process/output_file.hpp"
#include "host/text/printable.hpp"
#include "shm/segment/dead_segments.hpp"

namespace tandem::wheelchair {
namespace {

/// Throws for invalid input before any host is started.
void check(const Options& options) {
    load_scenario(options.scenario, options.joystick_file);
    if (!options.plot.empty()) check_figure_path(options.plot);
    for (const auto& path : {options.csv, options.plot, options.json, options.record})
        if (!path.empty() && !std::filesystem::is_directory(std::filesystem::path(path).parent_path()))
            throw InputError(path + ": its folder does not exist; create it first");
}

/// Returns DIR/log-mixed.csv for DIR/log.csv, because --compare writes one file per configuration.
std::string with_name(const std::string& path, Configuration configuration) {
    const std::filesystem::path p(path);
    return (p.parent_path() / (p.stem().string() + "-" + name_of(configuration) + p.extension().string()))
        .string();
}

// Draws one figure: of all runs with --compare, otherwise of the only run.
void draw(const Options& options, const Report& report) {
    const bool simulated = options.lockstep || options.configuration == Configuration::memory;
    const std::string kind = simulated ? "simulated time" : "real time";
    if (options.compare) {
        std::vector<std::pair<std::string, std::vector<Row>>> curves;
        for (const RunResult& r : report.runs) curves.emplace_back(name_of(r.configuration), r.rows);
        draw_comparison(options.plot,
                        fmt::format("{}: measured steering angle, {}", report.runs[0].scenario, kind),
                        curves);
    } else {
        const RunResult& r = report.runs.front();
        draw_run(options.plot, fmt::format("{}, {}, {}", r.scenario, name_of(r.configuration), kind), r.rows);
    }
}

void write_files(const Options& options, const Report& report) {
    for (const RunResult& r : report.runs)
        if (!options.csv.empty())
            process::write_output(options.compare ? with_name(options.csv, r.configuration) : options.csv,
                                  csv_text(r.rows));
    if (!options.json.empty()) write_json(options.json, report);
    if (!options.plot.empty()) draw(options, report);
}

// Performs the runs, prints the report and writes the files. Returns exit code 0 if all checks pass.
int perform_runs(Options options) {
    std::optional<LiveDrive> live;
    if (options.drive) {
        command::print_note(
            "wheelchair: drive with a gamepad, or run tandem monitor --control and open the view "
            "Wheelchair of its page\n");
        live.emplace();
        options.joystick_file = live->stick_file();
        options.drive_socket = live->socket();
    }
    check(options);
    std::vector<Configuration> configurations{options.configuration};
    // The mixed run is last, because the report compares it with each of the others.
    if (options.compare) configurations = {Configuration::opros, Configuration::rtm, Configuration::mixed};
    std::vector<RunResult> runs;
    runs.reserve(configurations.size());
    for (auto configuration : configurations) runs.push_back(run(options, configuration));
    // Prints the report before it writes files, so that a full disk does not lose it.
    const Report report = make_report(std::move(runs), options);
    const bool printed =
        std::fputs(text::printable_text(text_of(report)).c_str(), stdout) >= 0 && std::fflush(stdout) == 0;
    if (!printed) std::fputs("wheelchair: the report could not be written to standard output\n", stderr);
    for (const RunResult& r : report.runs)
        for (const auto& failure : r.failures)
            command::print_note("wheelchair: {}: {}\n", name_of(r.configuration),
                                text::printable_line(failure));
    write_files(options, report);
    return report.good() && printed ? 0 : 1;
}

/// Parses the command line, performs the runs, prints the report and writes the files. Returns the exit code: 0 if all
/// checks pass, 1 if not, 130 after an interrupt. [main thread]
int drive(int argc, char** argv) {
    log::hold_standard_streams();
    log::outlive_output_failures(); // so that failed output does not prevent an orderly end of the hosts
    const Options options = parse_options(argc, argv);
    shm::remove_dead_segments();
    try {
        return perform_runs(options);
    } catch (const hosts::Interrupted&) {
        command::print_note("wheelchair: interrupted, hosts stopped\n");
        return 130;
    } catch (const std::exception& e) {
        command::print_note("wheelchair: {}\n", text::printable_line(e.what()));
        return 1;
    }
}

} // namespace
} // namespace tandem::wheelchair

int main(int argc, char** argv) { return tandem::wheelchair::drive(argc, argv); }
