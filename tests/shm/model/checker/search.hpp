// SPDX-License-Identifier: Apache-2.0
// Runs a scenario: every execution of it, or many random ones.
#pragma once
#include "tests/shm/model/checker/execution.hpp"

namespace tandem::shm::model {

/// A scenario makes its objects, names its threads with Execution::thread(), calls run(), and looks at the
/// result.
using Scenario = std::function<void(Execution&)>;

struct Outcome {
    std::size_t executions = 0; ///< that came to their end
    std::size_t redundant = 0;  ///< left when it was clear that the rest was explored before
    std::size_t steps = 0;
    bool complete = false; ///< a search that has seen everything
    std::string failure;   ///< the first one: what, and every step that led there
    bool passed() const { return failure.empty(); }
};

struct Effort {
    Settings settings;
    std::size_t executions = 1'000'000'000; ///< limit; a search that reaches it is incomplete
    std::optional<std::uint64_t> seed;      ///< random executions instead of all
    const Mutation* mutation = nullptr;
    AccessLog* log = nullptr;
};

inline Outcome explore(const Scenario& scenario, const Effort& effort) {
    auto choices = effort.seed ? Choices(*effort.seed) : Choices();
    Execution execution(choices);
    Outcome outcome;
    const auto once = [&](std::uint64_t number, bool traced) {
        choices.begin(number);
        execution.set_fresh_from(choices.fresh_from());
        execution.begin(effort.settings, effort.mutation, effort.log, traced);
        try {
            scenario(execution);
        } catch (const Ended&) {
        }
    };
    for (std::uint64_t number = 0; number < effort.executions; ++number) {
        once(number, false);
        ++(execution.redundant() ? outcome.redundant : outcome.executions);
        outcome.steps += execution.steps();
        if (execution.failed()) {
            once(number, true);
            outcome.failure = execution.failure() + "\n";
            if (effort.seed)
                outcome.failure += "  random execution " + std::to_string(number) + " of seed " +
                                   std::to_string(*effort.seed) + "\n";
            for (const auto& line : execution.trace()) outcome.failure += "  " + line + "\n";
            return outcome;
        }
        if (!effort.seed && !choices.next()) {
            outcome.complete = true;
            return outcome;
        }
    }
    return outcome;
}

} // namespace tandem::shm::model
