// SPDX-License-Identifier: Apache-2.0
// The test of a set of scenarios by mutants, and what it reports.
#pragma once
#include "tests/shm/fixture.hpp"
#include "tests/shm/model/mutation/mutants.hpp"

namespace tandem::shm::model {

/// `random`: random executions per scenario and mutant; `searched`: executions of a search. TANDEM_MODEL_SIZES=1 names each
/// mutant and the scenario that caught it; with TANDEM_STRESS those that are spared are tried, too.
inline void check_mutations(std::vector<Case> cases, const std::vector<Spared>& spared, std::size_t random,
                            std::size_t searched) {
    const bool everything = test::stress(1) > 1;
    const MutantRun run(TANDEM_SOURCE_DIR, std::move(cases), random, searched);
    const Mutants result = run.run(spared, everything);
    if (std::getenv("TANDEM_MODEL_SIZES") != nullptr) {
        for (const auto& line : result.by) std::printf("caught: %s\n", line.c_str());
        std::printf("%zu mutants, %zu caught, %zu spared\n", result.all, result.caught, result.spared);
    }
    CHECK(result.survived == std::vector<std::string>{});
    for (const auto& one : spared) {
        INFO(one.file << " `" << one.text << "` spared: " << one.why);
        CHECK(result.used.count(&one) == 1); // an excuse for code that no longer exists is an error
    }
    CHECK(result.caught != 0);
}

} // namespace tandem::shm::model
