// SPDX-License-Identifier: Apache-2.0
#include "tests/shm/model/scenarios/doorbell_scenarios.hpp"
#include "tests/shm/model/scenarios/explore_cases.hpp"

namespace tandem::shm::model {
namespace {

TEST_CASE("No ring at a doorbell is lost in any order of steps") {
    search_all(doorbell_cases(), test::stress(10'000));
}

TEST_CASE("The doorbell is sound in random orders of steps") {
    run_at_random(doorbell_cases(), test::stress(2'000));
}

} // namespace
} // namespace tandem::shm::model
