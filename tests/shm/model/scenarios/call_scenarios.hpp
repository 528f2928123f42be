// SPDX-License-Identifier: Apache-2.0
// All scenarios of the call queue.
#pragma once
#include "tests/shm/model/scenarios/call_end_scenarios.hpp"
#include "tests/shm/model/scenarios/call_wait_scenarios.hpp"

namespace tandem::shm::model {

inline std::vector<Case> call_cases() {
    auto cases = call_wait_cases();
    for (auto& one : call_end_cases()) cases.push_back(std::move(one));
    return cases;
}

} // namespace tandem::shm::model
