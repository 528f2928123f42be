// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/options.hpp"

#include "host/options/usage_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tandem_version.hpp>

namespace tandem::bench {

Options read_options(int argc, char** argv, int& exit_code) {
    Options options;
    CLI::App app("Latency and throughput of Tandem, of the machine's own limits (baseline), and of other "
                 "middleware (peers).");
    app.set_version_flag("--version", std::string("tandem-bench ") + version);
    app.add_flag("--list", options.list, "Print the names of the cases and stop");
    app.add_option("--only", options.only,
                   "Measure the cases whose name contains one of these words, comma-separated");
    app.add_flag("--quick", options.quick, "Few samples: seconds instead of minutes, rough figures");
    app.add_option("--runs", options.runs,
                   "Measure everything N times and report the median (default 1; with --acceptance 5)")
        ->check(CLI::Range(1, 100));
    app.add_option("--tail-messages", options.tail_messages,
                   "Messages of each case of tails, one a millisecond, beside as many over the minimal ring "
                   "(default 5000, with --quick 1000)")
        ->check(CLI::Range(1000, 10'000'000));
    app.add_option("--cores", options.cores, "Cores of the two sides of a case, A,B (default: the first two)")
        ->delimiter(',')
        ->expected(1, 2);
    app.add_option("--json", options.json,
                   "Write the report as JSON; apps/bench/report.py draws and compares reports");
    // --bar is the former name of the option; scripts may still use it.
    app.add_flag("--acceptance,--bar", options.acceptance,
                 "Measure the cases with acceptance limits, and print value, limit, pass or FAIL");
    app.add_flag("--path-functions", options.path_functions,
                 "With the cases of path: name the functions, with the instructions that each takes");
    app.add_flag("--quiet", options.quiet, "No progress on stderr");
    // CLI11 reports errors and --help by exceptions; exit() prints them.
    exit_code = -1;
    app.failure_message(tandem::options::usage_error);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) { // or a request for help
        exit_code = app.exit(error);
    }
    return options;
}

Budget budget_of(const Options& options) {
    Budget budget;
    // About a tenth of everything: enough to see that a case works, not to compare two versions.
    if (options.quick) {
        budget.warm_up = 2'000;
        budget.samples = 5'000;
        budget.warm_up_seconds = 0.05;
        budget.seconds = 0.2;
        budget.window_seconds = 0.03;
        budget.timeout_seconds = 10;
        budget.attempts = 1;
        budget.tail_messages = 1'000;
    }
    if (options.tail_messages > 0) {
        budget.tail_messages = options.tail_messages;
        budget.timeout_seconds += 3e-3 * static_cast<double>(options.tail_messages);
    }
    return budget;
}

Cores cores_of(const Options& options) {
    // Checked here, so that a wrong core is one line and not the failure of each case.
    const std::vector<int> allowed = allowed_cores();
    const std::vector<int>& wanted = options.cores.empty() ? allowed : options.cores;
    for (int core : options.cores)
        if (std::find(allowed.begin(), allowed.end(), core) == allowed.end())
            throw std::runtime_error(
                fmt::format("--cores: this process may not use core {}; see taskset -p {}", core, getpid()));
    return {wanted.front(), wanted.size() > 1 ? wanted[1] : wanted.front()};
}

} // namespace tandem::bench
