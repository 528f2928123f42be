// SPDX-License-Identifier: Apache-2.0
// Checks that the model check of the cell ring detects damaged code. Every access of the shipping code is weakened or broken,
// one at a time.
#include "tests/host/rt/model/cell_ring_scenarios.hpp"
#include "tests/shm/model/mutation/mutation_check.hpp"

namespace tandem::shm::model::cell_ring_mutation {
namespace {

constexpr auto order = Damage::weaker_order, no_store = Damage::no_store;
constexpr const char* ring = "cell_ring.hpp";
constexpr const char* copying = "the word tells a torn copy; the order of each copied word is free on x86-64";
constexpr const char* counting = "a value that this end does not see yet is read or counted the next time";

const std::vector<Spared> spared{
    {ring, "A::store(cell.words[i]", no_store, {}, "addresses that are only prefetched"},
    {ring, "A::copy_atomic_to_shared(", order, {}, copying},
    {ring, "A::copy_atomic_from_shared(", order, {}, copying},
    {ring, "published_.store(writer_.position", order, {}, counting},
    {ring, "published = published_.load(", order, {}, counting},
    {ring, "published_.load(std::memory_order_acquire) - depth()", order, {}, counting},
};

TEST_CASE("Each damaged access of the cell ring is noticed") {
    check_mutations(cell_ring_cases(), spared, 3'000, 2'000);
}

} // namespace
} // namespace tandem::shm::model::cell_ring_mutation
