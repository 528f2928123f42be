// SPDX-License-Identifier: Apache-2.0
#include "tests/host/rt/model/cell_ring_scenarios.hpp"
#include "tests/shm/model/scenarios/explore_cases.hpp"

namespace tandem::shm::model {
namespace {

TEST_CASE("Values of a cell ring are whole, in order and counted exactly in any order of steps") {
    search_all(cell_ring_cases(), test::stress(6'000));
}

TEST_CASE("A cell ring is sound in random orders of steps") {
    run_at_random(cell_ring_cases(), test::stress(2'000));
}

} // namespace
} // namespace tandem::shm::model
