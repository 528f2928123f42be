// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/forked_children.hpp"
#include "apps/bench/report/acceptance.hpp"
#include "apps/bench/report/table.hpp"
#include "apps/bench/suite.hpp"
#include "host/options/usage_error.hpp"
#include "host/process/output_file.hpp"
#include "host/text/printable.hpp"
#include "shm/segment/dead_segments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <tandem_version.hpp>
#include <unistd.h>

namespace {

using namespace tandem::bench;

/// The command line of tandem-bench.
struct Options {
    std::string only, json;
    bool list = false, path_functions = false, quick = false, acceptance = false, quiet = false;
    std::size_t tail_messages = 0; ///< 0: the number in the budget
    int runs = 0;                  ///< 0: one, or five with --acceptance
    std::vector<int> cores;        ///< of A and B; empty: the first two that are allowed
};

/// Reads the command line. After help or an error was printed, exit_code is not -1 and the program must end.
Options read_options(int argc, char** argv, int& exit_code) {
    Options options;
    CLI::App app("Latency and throughput of Tandem, of the machine's own limits (baseline), and of other "
                 "middleware (peers).");
    app.set_version_flag("--version", std::string("tandem-bench ") + tandem::version);
    app.add_flag("--list", options.list, "Print the names of the cases and stop");
    app.add_option("--only", options.only,
                   "Measure the cases whose name contains one of these words, comma-separated");
    app.add_flag("--quick", options.quick, "Few samples: about a tenth of the time, rough figures");
    app.add_option("--runs", options.runs,
                   "Measure everything N times and report the median (default 1; with --acceptance 5)")
        ->check(CLI::Range(1, 100));
    app.add_option("--tail-messages", options.tail_messages,
                   "Number of messages of each case of tails (default 5000, with --quick 1000)")
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
                 "List the functions of each path case, with their instructions");
    app.add_flag("--quiet", options.quiet, "No progress on stderr");
    exit_code = tandem::options::parse(app, argc, argv).value_or(-1);
    return options;
}

/// The budget of a case: seconds with --quick, otherwise minutes.
Budget budget_of(const Options& options) {
    Budget budget;
    // About a tenth of everything: enough to see that a case works, not enough to compare two versions.
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

/// Returns two of the cores that this process may use: those of --cores, or the first two, or the only one
/// twice. Throws std::runtime_error if --cores names another core.
Cores cores_of(const Options& options) {
    // Checked here, so that a wrong core is one line and not a failure of each case.
    const std::vector<int> allowed = allowed_cores();
    const std::vector<int>& wanted = options.cores.empty() ? allowed : options.cores;
    for (int core : options.cores)
        if (std::find(allowed.begin(), allowed.end(), core) == allowed.end())
            throw std::runtime_error(
                fmt::format("--cores: this process may not use core {}; see taskset -p {}", core, getpid()));
    return {wanted.front(), wanted.size() > 1 ? wanted[1] : wanted.front()};
}

/// Returns the limits that this build can check: a peer without cases has none.
std::vector<AcceptanceLimit> limits_for(const Registry& registry) {
    std::vector<std::string> ids;
    for (const Case& entry : registry.cases) ids.push_back(entry.id());
    return acceptance_limits(ids);
}

/// Returns, with --acceptance and without --only, exactly the cases that the limits refer to.
Plan plan_of(const Options& options, const Registry& registry, const std::vector<AcceptanceLimit>& limits) {
    Plan plan;
    plan.cases = selected(registry.cases, options.only);
    if (options.acceptance && options.only.empty())
        std::erase_if(plan.cases,
                      [&](const Case& entry) { return !needed_for_acceptance(limits, entry.id()); });
    if (plan.cases.empty())
        throw std::runtime_error(
            fmt::format("--only {}: no case has a name that contains it; see --list", options.only));
    plan.skipped = registry.skipped;
    plan.budget = budget_of(options);
    plan.cores = cores_of(options);
    plan.runs = options.runs > 0 ? options.runs : options.acceptance ? 5 : 1;
    if (options.acceptance) plan.limits = limits;
    plan.progress = !options.quiet && isatty(STDERR_FILENO) != 0;
    return plan;
}

/// Carries out --list.
int list(const Options& options, const Registry& registry) {
    for (const Case& entry : selected(registry.cases, options.only)) fmt::print("{}\n", entry.id());
    for (const SkippedPeer& skipped : registry.skipped)
        fmt::print("skipped {}: {}\n", skipped.subject, skipped.reason);
    return 0;
}

/// Returns the exit code: 1 if the acceptance limits are not met (see is_accepted()), 130 (as after SIGINT) if interrupted.
int run(const Options& options) {
    const Registry registry = all_cases();
    // --list measures nothing and needs no privileges.
    if (options.list) return list(options, registry);
    const auto limits = limits_for(registry);
    const Plan plan = plan_of(options, registry, limits);
    tandem::shm::remove_dead_segments();
    // Before the first fork: children inherit the calibrated clock.
    catch_interrupts();
    Clock::calibrate();
    const Report report = measure(plan);
    const auto results =
        options.acceptance ? check_acceptance(limits, report) : std::vector<AcceptanceResult>{};
    fmt::print("{}", table_text(report));
    fmt::print("{}", path_text(report, options.path_functions));
    if (options.acceptance) fmt::print("\n{}", acceptance_text(results));
    if (!options.json.empty()) tandem::process::write_output(options.json, to_json(report));
    if (interrupted()) return 130;
    return !options.acceptance || is_accepted(results) ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    try {
        int exit_code = -1;
        const Options options = read_options(argc, argv, exit_code);
        return exit_code >= 0 ? exit_code : run(options);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "tandem-bench: %s\n",
                     tandem::text::printable_line(failure.what())
                         .c_str()); // fmt::print() would throw if it cannot write
        return 1;
    }
}
