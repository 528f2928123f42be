// SPDX-License-Identifier: Apache-2.0
#include "shm/wait/adaptive_spin.hpp"

#include <catch2/catch.hpp>

using tandem::shm::AdaptiveSpin;

TEST_CASE("the time to spin shrinks while waits are long and comes back with a short one") {
    constexpr std::uint64_t full = 50'000;
    AdaptiveSpin spin;
    CHECK(spin.limit_ns(full) == full);
    spin.learn(full, 10 * full);
    CHECK(spin.limit_ns(full) == full / 2);
    for (int i = 0; i < 100; ++i) spin.learn(full, 1'000'000'000);
    CHECK(spin.limit_ns(full) == 2'000);
    spin.learn(full, 3 * full); // neither short nor far beyond
    CHECK(spin.limit_ns(full) == 2'000);
    spin.learn(full, full + full / 2);
    CHECK(spin.limit_ns(full) == full);
}

TEST_CASE("a time to spin below the shortest is left alone") {
    AdaptiveSpin spin;
    for (int i = 0; i < 100; ++i) spin.learn(500, 1'000'000);
    CHECK(spin.limit_ns(500) == 500);
    CHECK(spin.limit_ns(0) == 0);
}
