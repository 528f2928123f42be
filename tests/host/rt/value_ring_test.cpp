// SPDX-License-Identifier: Apache-2.0
#include "host/rt/value_ring.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <thread>
#include <vector>

using tandem::rt::ValueRing;

namespace {

using Ring = ValueRing<std::vector<int>>;

bool put(Ring& ring, int value) {
    ring.next() = {value};
    return ring.publish();
}

std::optional<int> take(Ring& ring) { return ring.take() ? std::optional(ring.last().at(0)) : std::nullopt; }

std::optional<int> take_short(Ring& ring) {
    int value = 0;
    if (!ring.take() || ring.taken_short() == nullptr || ring.taken_short()->size() != sizeof value)
        return std::nullopt;
    std::memcpy(&value, ring.taken_short()->bytes(), sizeof value);
    return value;
}

std::optional<int> peek(Ring& ring) { return ring.peek() ? std::optional(ring.last().at(0)) : std::nullopt; }

} // namespace

TEST_CASE("a value ring gives values in order and keeps as many of the newest as its depth") {
    const std::size_t depth = GENERATE(1U, 2U, 3U, 8U);
    Ring ring(depth);
    CHECK(ring.depth() == depth);
    CHECK(ring.empty());
    CHECK_FALSE(take(ring));
    for (int written = 1; written < 50; ++written) {
        const bool was_full = ring.is_full();
        CHECK(put(ring, written) == was_full);
        CHECK(ring.size() == std::min<std::size_t>(depth, static_cast<std::size_t>(written)));
    }
    for (int expected = 50 - static_cast<int>(depth); expected < 50; ++expected)
        CHECK(take(ring) == expected);
    CHECK_FALSE(take(ring));
    for (int next = 50; next < 60; ++next) { // the reader keeps up
        CHECK_FALSE(put(ring, next));
        CHECK(take(ring) == next);
        CHECK(ring.size() == 0);
    }
}

TEST_CASE("a value ring counts the values that were published and taken, and none when it is new") {
    const std::size_t depth = GENERATE(1U, 3U);
    Ring ring(depth);
    CHECK(ring.published() == 0);
    CHECK(ring.taken() == 0);
    put(ring, 1);
    take(ring);
    put(ring, 2);
    CHECK(ring.published() == 2);
    CHECK(ring.taken() == 1);
}

TEST_CASE("a peeked value stays in a value ring until it is taken or too old") {
    Ring ring(2);
    put(ring, 1);
    CHECK(peek(ring) == 1);
    CHECK(peek(ring) == 1);
    CHECK(ring.size() == 1);
    CHECK_FALSE(ring.empty());
    put(ring, 2);
    CHECK(ring.size() == 2);
    CHECK(take(ring) == 1);
    CHECK(peek(ring) == 2);
    put(ring, 3);
    put(ring, 4); // the ring keeps 3 and 4
    CHECK(ring.size() == 2);
    CHECK(peek(ring) == 3);
    CHECK(take(ring) == 3);
    CHECK(take(ring) == 4);
    CHECK_FALSE(peek(ring));
}

TEST_CASE("values of a value ring are found by offset, and both ends can go back") {
    Ring ring(4);
    for (int value = 1; value <= 3; ++value) put(ring, value);
    for (int i = 0; i < 3; ++i) CHECK(ring.at(ring.readers(i)).at(0) == i + 1);
    for (int i = -1; i >= -3; --i) CHECK(ring.at(ring.writers(i)).at(0) == 4 + i);
    const auto next = ring.writers(0), second_next = ring.writers(1);
    CHECK(take(ring) == 1);
    CHECK(take(ring) == 2);
    CHECK(ring.at(ring.readers(-1)).at(0) == 2);
    CHECK(ring.at(ring.readers(-2)).at(0) == 1);
    ring.untake();
    ring.untake();
    CHECK(ring.size() == 3);
    ring.unpublish();
    CHECK(ring.size() == 2);
    CHECK(take(ring) == 1);
    put(ring, 5);
    CHECK(ring.writers() == next);
    put(ring, 6);
    CHECK(ring.writers() == second_next);
    for (const int expected : {2, 5, 6}) CHECK(take(ring) == expected);
    for (int value = 7; value <= 12; ++value) put(ring, value);
    ring.settle([](std::uint32_t, const Ring::Content&) {});
    for (int i = 0; i < 4; ++i) CHECK(ring.at(ring.readers(i)).at(0) == 9 + i);
}

TEST_CASE("a value ring gives short and other values in order, with their bytes") {
    Ring ring(3);
    for (int value = 1; value <= 4; ++value) {
        CHECK_FALSE(ring.publish_short(&value, sizeof value));
        CHECK_FALSE(put(ring, -value));
        CHECK(take_short(ring) == value);
        CHECK(take(ring) == -value);
        CHECK(ring.taken_short() == nullptr);
    }
    const std::vector<unsigned char> bytes(Ring::Content::max_size + 1, 7);
    for (std::size_t size = 0; size <= Ring::Content::max_size; ++size) {
        ring.publish_short(bytes.data(), size);
        CHECK(ring.peek());
        REQUIRE(ring.take());
        REQUIRE(ring.taken_short() != nullptr);
        CHECK(ring.taken_short()->size() == size);
        CHECK(
            std::equal(bytes.begin(), bytes.begin() + static_cast<long>(size), ring.taken_short()->bytes()));
    }
}

TEST_CASE("a short value touches no value of a value ring, only its cell") {
    Ring ring(3);
    for (int value = 0; value < 20; ++value) {
        ring.publish_short(&value, sizeof value);
        CHECK(take_short(ring) == value);
    }
    for (std::uint32_t i = 0; i < ring.depth() + 3; ++i) CHECK(ring.at(i).capacity() == 0);
}

TEST_CASE("values of a value ring are found by offset after the short ones were settled") {
    Ring ring(4);
    const auto settle = [&] {
        ring.settle([&](std::uint32_t index, const Ring::Content& value) {
            ring.at(index).resize(1);
            std::memcpy(ring.at(index).data(), value.bytes(), value.size());
        });
    };
    for (int value = 1; value <= 4; ++value) // 2 is a long one
        if (value == 2)
            put(ring, value);
        else
            ring.publish_short(&value, sizeof value);
    const int taken = GENERATE(0, 1, 2, 3, 4);
    for (int value = 1; value <= taken; ++value) CHECK(ring.take());
    settle();
    CHECK(ring.taken_short() == nullptr);
    for (int i = -taken; i < 4 - taken; ++i) CHECK(ring.at(ring.readers(i)).at(0) == taken + i + 1);
    for (int i = -1; i >= taken - 4; --i) CHECK(ring.at(ring.writers(i)).at(0) == 5 + i);
    for (int i = 0; i < taken; ++i) ring.untake();
    for (int value = 1; value <= 4; ++value) CHECK(take(ring) == value);
}

// Each value is whole and comes once, in order. What was not read was reported as dropped.
TEST_CASE("no value of a value ring is torn, repeated or lost uncounted while both threads run") {
    const std::size_t depth = GENERATE(1U, 2U, 7U);
    const bool peeks = GENERATE(false, true);
    ValueRing<std::vector<std::uint64_t>> ring(depth);
    constexpr std::uint64_t last = 200'000;
    constexpr std::size_t words = 12, short_words = 6;
    std::uint64_t dropped = 0, received = 0, newest = 0, faults = 0;
    const auto is_short = [](std::uint64_t value) { return value / 64 % 3 != 0; }; // some in a row
    std::thread writer([&] {
        std::array<std::uint64_t, short_words> bytes{};
        for (std::uint64_t value = 1; value <= last; ++value) {
            if (is_short(value)) {
                bytes.fill(value);
                if (ring.publish_short(bytes.data(), sizeof bytes)) ++dropped;
                continue;
            }
            ring.next().assign(words, value);
            if (ring.publish()) ++dropped;
        }
    });
    std::vector<std::uint64_t> value;
    while (newest != last) {
        if (peeks ? !ring.peek() : ring.empty()) continue;
        if (!ring.take()) { // a ring that has a value never looks empty
            ++faults;
            continue;
        }
        if (const auto* bytes = ring.taken_short()) {
            value.resize(bytes->size() / sizeof value[0]);
            std::memcpy(value.data(), bytes->bytes(), bytes->size());
        } else {
            value = ring.last();
        }
        ++received;
        if (value.size() != (is_short(value.front()) ? short_words : words) || value.front() <= newest)
            ++faults;
        newest = value.front();
        for (const std::uint64_t word : value)
            if (word != newest) ++faults;
    }
    writer.join();
    CHECK(faults == 0);
    // The writer does not know of a peeked value that became too old.
    if (!peeks) CHECK(received + dropped == last);
    CHECK(ring.empty());
}
