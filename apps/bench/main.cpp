// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/forked_children.hpp"
#include "apps/bench/options.hpp"
#include "apps/bench/report/acceptance.hpp"
#include "apps/bench/report/table.hpp"
#include "shm/segment/dead_segments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <unistd.h>

namespace {

using namespace tandem::bench;

/// Throws std::runtime_error, after closing: a full disk shows then.
void write_file(const std::string& path, const std::string& text) {
    std::ofstream file(path);
    file << text;
    file.close();
    if (!file) throw std::runtime_error(fmt::format("cannot write {}; check that its folder exists", path));
}

/// The limits that this build can check: a peer without cases has none.
std::vector<AcceptanceLimit> limits_for(const Registry& registry) {
    std::vector<std::string> ids;
    for (const Case& entry : registry.cases) ids.push_back(entry.id());
    return acceptance_limits(ids);
}

/// With --acceptance and no --only, the cases that the limits refer to and no others.
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

/// --list.
int list(const Options& options, const Registry& registry) {
    for (const Case& entry : selected(registry.cases, options.only)) fmt::print("{}\n", entry.id());
    for (const SkippedPeer& skipped : registry.skipped)
        fmt::print("skipped {}: {}\n", skipped.subject, skipped.reason);
    return 0;
}

/// The exit code: 1 if an acceptance limit is not met, 130 (as after SIGINT) if interrupted.
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
    if (!options.json.empty()) write_file(options.json, to_json(report));
    if (interrupted()) return 130;
    const bool failed = std::any_of(results.begin(), results.end(),
                                    [](const AcceptanceResult& result) { return result.failed(); });
    return failed ? 1 : 0;
}

} // namespace

int main(int argc, char** argv) {
    int exit_code = -1;
    const Options options = read_options(argc, argv, exit_code);
    if (exit_code >= 0) return exit_code;
    try {
        return run(options);
    } catch (const std::exception& failure) {
        fmt::print(stderr, "tandem-bench: {}\n", failure.what());
        return 1;
    }
}
