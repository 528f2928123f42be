// SPDX-License-Identifier: Apache-2.0
#include "tests/shm/fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;
using Catch::Contains;

TEST_CASE("the peer sees all published objects at once") {
    Pair pair;
    auto blob = pair.first->add_blob("table", 100);
    std::memcpy(blob.data(), "hello", 5);
    pair.first->add_ring("ring", {});
    CHECK_FALSE(pair.second->peer_published());
    CHECK_FALSE(pair.second->find_blob(Side::first, "table"));
    CHECK(pair.second->list(Side::first).empty());
    pair.first->publish();
    CHECK(pair.second->doorbell().poll() == ReadyBits{Doorbell::attention_bit});
    REQUIRE(pair.second->peer_published());
    CHECK(pair.second->list(Side::first).size() == 2);
    CHECK(text_of(*pair.second->copy_blob(Side::first, "table")).substr(0, 5) == "hello");
    CHECK(pair.second->find_ring(Side::first, "ring"));
    CHECK_FALSE(pair.second->find_ring(Side::first, "table")); // another kind
    CHECK_FALSE(pair.second->find_ring(Side::second, "ring")); // another half
    CHECK(pair.first->find_ring(Side::first, "ring"));
}

TEST_CASE("further objects may be published later") {
    Pair pair;
    pair.first->publish();
    CHECK(pair.second->peer_published());
    pair.first->add_blob("late", 8);
    CHECK_FALSE(pair.second->find_blob(Side::first, "late"));
    pair.first->publish();
    CHECK(pair.second->find_blob(Side::first, "late"));
}

TEST_CASE("an object that does not fit is refused with needed and available bytes") {
    Pair pair(small(64 * 1024));
    CHECK_THROWS_WITH(pair.first->add_blob("b", 100 * 1024),
                      Contains("needs 102400") && Contains("65536 are left"));
    CHECK_THROWS_AS(pair.first->add_blob("b", ~std::size_t{0}), Error);
    CHECK_THROWS_AS(pair.first->add_ring("r", {.capacity = 1 << 20}), Error);
    CHECK_NOTHROW(pair.first->add_blob("b", 64 * 1024));
    CHECK_THROWS_AS(pair.first->add_blob("c", 1), Error);
}

TEST_CASE("names are checked and are unique on a side") {
    Pair pair;
    pair.first->add_blob("x", 8);
    CHECK_THROWS_WITH(pair.first->add_blob("x", 8), Contains("already exists"));
    CHECK_NOTHROW(pair.second->add_blob("x", 8));
    CHECK_THROWS_AS(pair.first->add_blob("", 8), Error);
    CHECK_THROWS_AS(pair.first->add_blob(std::string(104, 'n'), 8), Error);
    CHECK_NOTHROW(pair.first->add_blob(std::string(103, 'n'), 8));
}

TEST_CASE("a directory takes 512 objects") {
    Pair pair;
    for (std::size_t i = 0; i < layout::max_objects; ++i) pair.first->add_blob(std::to_string(i), 1);
    CHECK_THROWS_WITH(pair.first->add_blob("one more", 1), Contains("512"));
    pair.first->publish();
    CHECK(pair.second->list(Side::first).size() == 512);
}

TEST_CASE("invalid options are refused") {
    Pair pair;
    CHECK_THROWS_AS(pair.first->add_ring("r", {.max_record = std::size_t{1} << 40}), Error);
    CHECK_THROWS_AS(pair.first->add_call_queue("c", {.slots = 0}), Error);
    CHECK_THROWS_AS(pair.first->add_call_queue("c", {.slots = 1000}), Error);
    CHECK(pair.first->list(Side::first).empty());
}
