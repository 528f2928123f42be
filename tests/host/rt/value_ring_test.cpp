// SPDX-License-Identifier: Apache-2.0
#include "host/rt/value_ring.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <thread>
#include <vector>

using tandem::rt::ShortMessage;
using tandem::rt::ValueRing;

namespace {

using Ring = ValueRing<std::vector<int>>;

bool put(Ring& ring, int value) {
    ring.next() = {value};
    return ring.publish();
}

std::optional<int> take(Ring& ring) { return ring.take() ? std::optional(ring.last().at(0)) : std::nullopt; }

std::optional<int> peek(Ring& ring) { return ring.peek() ? std::optional(ring.last().at(0)) : std::nullopt; }

bool put_short(Ring& ring, int value) {
    ShortMessage message;
    message.assign(std::array<int, ShortMessage::max_bytes / sizeof(int)>{value}.data(), sizeof value);
    return ring.publish(message);
}

int number_in(const ShortMessage& message) {
    std::array<int, ShortMessage::max_bytes / sizeof(int)> values{};
    REQUIRE(message.bytes == sizeof(int));
    message.copy_to(values.data());
    return values[0];
}

/// Takes the next message and returns its number, negative if it was short.
std::optional<int> take_either(Ring& ring) {
    if (!ring.take()) return std::nullopt;
    return ring.short_message() ? -number_in(*ring.short_message()) : ring.last().at(0);
}

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
        CHECK(ring.waiting() == ring.size());
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
    for (int i = 0; i < 4; ++i) CHECK(ring.at(ring.readers(i)).at(0) == 9 + i);
}

// Each value is whole and comes once, in order. What was not read was reported as dropped.
TEST_CASE("no value of a value ring is torn, repeated or lost uncounted while both threads run") {
    const std::size_t depth = GENERATE(1U, 2U, 7U);
    const bool peeks = GENERATE(false, true);
    ValueRing<std::vector<std::uint64_t>> ring(depth);
    constexpr std::uint64_t last = 200'000;
    constexpr std::size_t words = 12;
    std::uint64_t dropped = 0, received = 0, newest = 0, faults = 0;
    std::thread writer([&] {
        for (std::uint64_t value = 1; value <= last; ++value) {
            ring.next().assign(words, value);
            if (ring.publish()) ++dropped;
        }
    });
    while (newest != last) {
        if (peeks) ring.peek();
        if (!ring.take()) continue;
        const auto& value = ring.last();
        ++received;
        if (value.size() != words || value.front() <= newest) ++faults;
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

TEST_CASE("a short message has each length up to its largest") {
    std::array<unsigned char, ShortMessage::max_bytes + 1> from{}, to{};
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<unsigned char>(i + 1);
    for (std::size_t bytes = 0; bytes <= ShortMessage::max_bytes; ++bytes) {
        ShortMessage message;
        message.assign(from.data(), bytes / 3);
        message.append(from.data() + bytes / 3, bytes - bytes / 3);
        REQUIRE(message.bytes == bytes);
        to.fill(0);
        message.copy_to(to.data());
        CHECK(std::equal(to.begin(), to.begin() + static_cast<std::ptrdiff_t>(bytes), from.begin()));
        CHECK(to[bytes] == 0);
    }
}

TEST_CASE("a value ring carries short messages between values, and drops none for a short message") {
    Ring ring(3);
    CHECK(put_short(ring, 1));
    put(ring, 2);
    CHECK(put_short(ring, 3));
    CHECK_FALSE(put_short(ring, 4));
    CHECK(ring.size() == 3);
    CHECK(take_either(ring) == -1);
    CHECK(put_short(ring, 4));
    CHECK(put(ring, 5)); // drops 2
    CHECK(put(ring, 6)); // drops a short one
    for (const int expected : {-4, 5, 6}) CHECK(take_either(ring) == expected);
    CHECK_FALSE(take_either(ring));
    CHECK(put_short(ring, 7));
    CHECK(ring.peek());
    CHECK(ring.size() == 1);
    CHECK(ring.waiting() == 1);
    CHECK(number_in(*ring.short_message()) == 7);
    CHECK(take_either(ring) == -7);
}

TEST_CASE("short messages of a value ring are found by offset, and both ends can go back") {
    Ring ring(4);
    for (int value = 1; value <= 3; ++value) put_short(ring, value);
    put(ring, 4);
    for (int i = 0; i < 3; ++i) CHECK(number_in(ring.readers_short(i).value()) == i + 1);
    CHECK_FALSE(ring.readers_short(3));
    CHECK_FALSE(ring.writers_short(-1));
    CHECK(number_in(ring.writers_short(-2).value()) == 3);
    CHECK(take_either(ring) == -1);
    CHECK(take_either(ring) == -2);
    CHECK(number_in(ring.readers_short(-1).value()) == 2);
    ring.untake();
    CHECK(number_in(*ring.short_message()) == 1); // the last one again
    CHECK(take_either(ring) == -2);
    ring.unpublish();
    put(ring, 5);
    for (const int expected : {-3, 5}) CHECK(take_either(ring) == expected);
    CHECK_FALSE(ring.readers_short(0)); // was read
}

// A short message that finds no room is followed by a value, which drops the oldest message.
TEST_CASE("no short message of a value ring is torn, repeated or lost uncounted while both threads run") {
    const std::size_t depth = GENERATE(1U, 2U, 7U);
    ValueRing<std::uint64_t> ring(depth);
    constexpr std::uint64_t last = 200'000;
    std::uint64_t dropped = 0, received = 0, newest = 0, faults = 0;
    std::thread writer([&] {
        for (std::uint64_t value = 1; value <= last; ++value) {
            ShortMessage message;
            message.words.fill(value);
            message.bytes = ShortMessage::max_bytes;
            if (value % 3 != 0 && ring.publish(message)) continue;
            ring.next() = value;
            if (ring.publish()) ++dropped;
        }
    });
    while (newest != last) {
        if (!ring.take()) continue;
        const ShortMessage* const message = ring.short_message();
        const std::uint64_t value = message ? message->words[0] : ring.last();
        ++received;
        if (value <= newest) ++faults;
        newest = value;
        for (std::size_t i = 0; message && i < message->words.size(); ++i)
            if (message->words[i] != newest) ++faults;
    }
    writer.join();
    CHECK(faults == 0);
    CHECK(received + dropped == last);
}
