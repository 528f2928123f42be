// SPDX-License-Identifier: Apache-2.0
#include "tests/shm/model/scenarios/explore_cases.hpp"
#include "tests/shm/model/scenarios/ring_scenarios.hpp"

namespace tandem::shm::model {
namespace {

TEST_CASE("Records are whole, in order and counted exactly in any order of steps") {
    search_all(ring_cases(), test::stress(6'000));
}

TEST_CASE("The ring is sound in random orders of steps") { run_at_random(ring_cases(), test::stress(2'000)); }

} // namespace
} // namespace tandem::shm::model
