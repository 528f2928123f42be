// SPDX-License-Identifier: Apache-2.0
// Lock-step runs with real hosts write the CSV of the in-memory run, byte for byte.
#include <catch2/catch.hpp>

#include "plugins/wheelchair/core/record/rows.hpp"
#include "program.hpp"
#include "scratch_dir.hpp"

using namespace tandem::wheelchair;

namespace {

void check_all_scenarios(const std::string& configuration) {
    for (const Scenario& scenario : scenarios()) {
        if (scenario.name == "recorded") continue;
        const ScratchDir dir;
        const std::string csv = dir / "run.csv";
        const auto result = wheelchair_program({"--config", configuration, "--scenario", scenario.name,
                                                "--lockstep", "--host-wait", "60", "--csv", csv});
        INFO(configuration << " " << scenario.name << ": " << result.errors);
        CHECK(result.exit_code() == 0);
        CHECK(result.errors.empty());
        const bool same = file_content(csv) == csv_text(simulate(scenario));
        CHECK(same);
    }
}

} // namespace

TEST_CASE("all-OPRoS lock-step is the in-memory run, byte for byte, in every scenario") {
    check_all_scenarios("opros");
}

TEST_CASE("all-RTM lock-step is the in-memory run, byte for byte, in every scenario") {
    check_all_scenarios("rtm");
}

TEST_CASE("mixed lock-step is the in-memory run, byte for byte, in every scenario") {
    check_all_scenarios("mixed");
}

TEST_CASE("swapped lock-step is the in-memory run, byte for byte, in every scenario") {
    check_all_scenarios("swapped");
}

TEST_CASE("split lock-step is the in-memory run, byte for byte, in every scenario") {
    check_all_scenarios("split");
}
