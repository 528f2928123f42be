// SPDX-License-Identifier: Apache-2.0
#include "tests/shm/model/scenarios/call_scenarios.hpp"
#include "tests/shm/model/scenarios/explore_cases.hpp"

namespace tandem::shm::model {
namespace {

TEST_CASE("Calls are answered once and no wake-up is lost in any order of steps") {
    search_all(call_wait_cases(), test::stress(2'500));
}

TEST_CASE("Calls that are given up or whose process dies leave the queue sound in any order of steps") {
    search_all(call_end_cases(), test::stress(2'500));
}

TEST_CASE("The call queue is sound in random orders of steps") {
    run_at_random(call_cases(), test::stress(2'000));
}

} // namespace
} // namespace tandem::shm::model
