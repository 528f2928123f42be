// SPDX-License-Identifier: Apache-2.0
// Runs the cases of a test: each searched up to a limit, and at random.
#pragma once
#include "tests/shm/fixture.hpp"
#include "tests/shm/model/scenarios/case.hpp"

namespace tandem::shm::model {

constexpr std::uint64_t seed = 20260101;

/// Searches the small ones completely, and `limit` executions of the others.
inline void search_all(const std::vector<Case>& cases, std::size_t limit) {
    for (const auto& one : cases) {
        Effort effort;
        effort.settings = one.settings;
        if (!one.small) effort.executions = limit;
        const auto outcome = explore(one.scenario, effort);
        INFO(one.name << ": " << outcome.executions << " executions");
        CHECK(outcome.failure == "");
        if (std::getenv("TANDEM_MODEL_SIZES") != nullptr)
            std::printf("%s: %zu executions%s, %zu left early, %zu steps\n", one.name, outcome.executions,
                        outcome.complete ? ", all" : "", outcome.redundant, outcome.steps);
        CHECK((outcome.complete || !one.small));
    }
}

inline void run_at_random(const std::vector<Case>& cases, std::size_t executions) {
    for (const auto& one : cases) {
        Effort effort;
        effort.settings = one.settings;
        effort.executions = executions;
        effort.seed = seed;
        INFO(one.name);
        CHECK(explore(one.scenario, effort).failure == "");
    }
}

} // namespace tandem::shm::model
