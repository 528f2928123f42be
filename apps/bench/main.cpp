// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/options.hpp"
#include "apps/bench/table.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <unistd.h>

namespace {

using namespace tandem::bench;

void write_file(const std::string& path, const std::string& text) {
    std::ofstream file(path);
    file << text;
    file.close();
    if (!file) throw std::runtime_error(fmt::format("cannot write {}; check that its folder exists", path));
}

int run(const Options& options) {
    const Registry registry = all_cases();
    Plan plan;
    plan.cases = selected(registry.cases, options.only);
    plan.skipped = registry.skipped;
    if (options.list) {
        for (const Case& one : plan.cases) fmt::print("{}\n", one.id());
        for (const Skipped& skipped : plan.skipped)
            fmt::print("skipped {}: {}\n", skipped.who, skipped.reason);
        return 0;
    }
    if (plan.cases.empty())
        throw std::runtime_error(
            fmt::format("--only {}: no case's name contains that; see --list", options.only));
    plan.limits = limits_of(options);
    plan.cores = cores_of(options);
    plan.runs = options.runs > 0 ? options.runs : 1;
    plan.progress = !options.quiet && isatty(STDERR_FILENO) != 0;
    catch_interrupts();
    Clock::calibrate();
    const Report report = measure(plan);
    fmt::print("{}", table_text(report));
    if (!options.json.empty()) write_file(options.json, to_json(report));
    return interrupted() ? 130 : 0;
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
