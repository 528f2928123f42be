// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/census/census_commands.hpp"

#include "apps/tandem/census/census.hpp"
#include "host/options/number_check.hpp"

#include <fmt/format.h>

#include <memory>

namespace tandem::command {

void add_census_command(CLI::App& parent, const CensusModel& model, const char* what, Action& selected) {
    auto options = std::make_shared<CensusOptions>();
    CLI::App* command = add_command(
        parent, "census", "Builds, loads and runs every component below folders, and says what is missing",
        fmt::format(
            R"(Finds {}. Builds each in a temporary folder, loads it, runs it
alone in a host, and prints a line with the first error and its remedy. Writes nothing into the
folders. Child processes have no input, at most 4 GiB of memory each and files of at most 256 MiB;
whatever a component leaves running is killed. Components run unchanged and may move hardware:
switch off the motors of connected robots first.
Exit code 0 if all components run, 2 if one does not, 1 if there is none or the census is interrupted.)",
            what));
    command->add_option("DIR", options->folders, "folder with components in it or below (repeatable)")
        ->required();
    command->add_option("--seconds", options->limits.run_s, "time for which each component runs (3)")
        ->type_name("SECONDS")
        ->check(options::number_between(0.1, 3600.));
    command
        ->add_option("--timeout", options->limits.build_s,
                     "time limit for configuring and for compiling each component (300)")
        ->type_name("SECONDS")
        ->check(options::number_between(0.1, 86400.));
    command->add_flag("--json", options->json, "print JSON at the end instead of a table");
    command->callback([=, &model, &selected] { selected = [=, &model] { return census(model, *options); }; });
}

} // namespace tandem::command
