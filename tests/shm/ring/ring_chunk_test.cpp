// SPDX-License-Identifier: Apache-2.0
// Payloads longer than a record: written and read in place, in chunks.
#include "shm/ring/message_snapshot.hpp"
#include "tests/shm/fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

constexpr std::size_t large = 20000;

struct ChunkPair : Pair {
    explicit ChunkPair(std::uint32_t chunks = 3)
        : writer(first->add_ring(
              "r", {.max_record = 100, .capacity = 4096, .chunk_bytes = large, .chunks = chunks})),
          reader((first->publish(), *second->find_ring(Side::first, "r"))) {}
    RingWriter writer;
    RingReader reader;
};

std::string image(char fill) { return std::string(large, fill); }

void check_chunk_books(const RingCounters& c, std::uint64_t waiting) {
    CHECK(c.sent == c.received + c.dropped() + waiting);
}

} // namespace

TEST_CASE("a payload longer than a record is written and read in the same place") {
    ChunkPair ring;
    CHECK(ring.writer.max_message() == round_up(large, layout::page));
    const auto room = ring.writer.reserve(large);
    REQUIRE(room.size() == large);
    std::memset(room.data(), 'i', large);
    REQUIRE(ring.writer.commit(large, 3));
    const auto record = ring.reader.read();
    REQUIRE(record);
    CHECK(text_of(record->bytes) == image('i'));
    CHECK(record->stamp_ns == 3);
    // Both ends map the same page of the file, so the reader sees a change by the writer.
    room[0] = std::byte{'!'};
    CHECK(record->bytes[0] == std::byte{'!'});
    CHECK(ring.writer.counters().bytes_sent == large);
    CHECK(ring.writer.counters().bytes_received == large);
    check_chunk_books(ring.writer.counters(), 0);
}

TEST_CASE("a snapshot of a message does not change with its chunk") {
    ChunkPair ring;
    MessageSnapshot snapshot;
    const auto room = ring.writer.reserve(large);
    std::memset(room.data(), 'i', large);
    REQUIRE(ring.writer.commit(large, 3));
    const auto* record = ring.reader.read();
    REQUIRE(record);
    const auto bytes = snapshot.of(*record);
    room[0] = std::byte{'!'};
    CHECK(text_of(bytes) == image('i'));
    // A record of the ring itself is private already.
    ring.writer.write(bytes_of("short"), 0);
    record = ring.reader.read();
    REQUIRE(record);
    CHECK(snapshot.of(*record).data() == record->bytes.data());
}

TEST_CASE("a chunk that a reader holds is not overwritten before its next read") {
    ChunkPair ring;
    ring.writer.write(bytes_of(image('a')), 0);
    const auto held = ring.reader.read();
    REQUIRE(held);
    for (char c = 'b'; c < 'k'; ++c) ring.writer.write(bytes_of(image(c)), 0);
    CHECK(text_of(held->bytes) == image('a'));
    const auto next = ring.reader.read();
    REQUIRE(next);
    CHECK(text_of(next->bytes) != image('a'));
    while (ring.reader.read()) {
    }
    check_chunk_books(ring.writer.counters(), 0);
}

TEST_CASE("small and large payloads keep their order, and chunks are reused forever") {
    ChunkPair ring(2);
    for (std::uint64_t round = 1; round <= 1000; ++round) {
        const bool in_chunk = round % 3 != 0;
        const std::string text = in_chunk ? image(static_cast<char>('a' + round % 26)) : "small";
        REQUIRE(ring.writer.write(bytes_of(text), round));
        const auto record = ring.reader.read();
        REQUIRE(record);
        REQUIRE(record->sequence == round);
        REQUIRE(record->bytes.size() == text.size());
        REQUIRE(text_of(record->bytes) == text);
    }
    check_chunk_books(ring.writer.counters(), 0);
}

TEST_CASE("when all chunks are in use the oldest message is dropped") {
    ChunkPair ring(3);
    for (std::uint64_t i = 1; i <= 10; ++i)
        ring.writer.write(bytes_of(image(static_cast<char>('0' + i % 10))), i);
    CHECK(ring.writer.counters().refused == 0);
    CHECK(ring.writer.counters().overwritten == 7);
    const auto record = ring.reader.read_newest();
    REQUIRE(record);
    CHECK(record->stamp_ns == 10);
    check_chunk_books(ring.writer.counters(), 0);
}

TEST_CASE("a writer knows beforehand whether a large payload costs an older message") {
    ChunkPair ring;
    for (int i = 0; i < 3; ++i) {
        CHECK(ring.writer.has_room(large));
        ring.writer.write(bytes_of(image('x')), 0);
    }
    CHECK_FALSE(ring.writer.has_room(large));
    CHECK(ring.writer.has_room(10));
    ring.reader.read();
    CHECK_FALSE(ring.writer.has_room(large)); // the reader holds it
    ring.reader.read();
    CHECK(ring.writer.has_room(large));
    CHECK_FALSE(ring.writer.has_room(2 * large)); // longer than a chunk
}

TEST_CASE("chunks that a reader skips for a newer record come back to the writer") {
    ChunkPair ring(4);
    for (std::uint64_t round = 1; round <= 20; ++round) {
        for (std::uint64_t i = 0; i < 3; ++i)
            REQUIRE(ring.writer.write(bytes_of(image('s')), 10 * round + i));
        const auto record = ring.reader.read_newest();
        REQUIRE(record);
        CHECK(record->stamp_ns == 10 * round + 2);
        CHECK(text_of(record->bytes) == image('s'));
    }
    check_chunk_books(ring.writer.counters(), 0);
}

TEST_CASE("a reader that goes away gives its chunk back") {
    ChunkPair ring(2);
    for (int round = 0; round < 10; ++round) {
        RingReader reader(*ring.second->find_ring(Side::first, "r"));
        REQUIRE(ring.writer.write(bytes_of(image('x')), 0));
        REQUIRE(reader.read());
    }
}

TEST_CASE("a payload longer than a chunk is refused and counted") {
    ChunkPair ring;
    CHECK(ring.writer.reserve(ring.writer.max_message() + 1).data() == nullptr);
    CHECK(ring.writer.counters().refused == 1);
}

TEST_CASE("a ring with chunks takes no second writer once it was written") {
    ChunkPair ring;
    const auto handle = *ring.first->find_ring(Side::first, "r");
    CHECK_NOTHROW(RingWriter(handle));
    ring.writer.write(bytes_of("x"), 0);
    CHECK_THROWS_AS(RingWriter(handle), Error);
}

TEST_CASE("invalid chunk options are refused when the ring is created") {
    Pair pair;
    CHECK_THROWS_AS(pair.first->add_ring("r", {.chunk_bytes = 1 << 20, .chunks = 1}), Error);
    CHECK_THROWS_AS(pair.first->add_ring("r", {.chunk_bytes = 4096, .chunks = 4}), Error);
    CHECK_THROWS_AS(pair.first->add_ring("r", {.chunk_bytes = 1 << 20, .chunks = 65}), Error);
    CHECK_THROWS_AS(pair.first->add_ring("r", {.chunks = 4}), Error);
}

TEST_CASE("sequence numbers stay right beyond the 32 bits that a record holds") {
    Pair pair;
    auto handle = pair.first->add_ring("r", {.max_record = 100, .capacity = 512});
    // Pretends that this number had been sent and overwritten before.
    constexpr std::uint64_t before = 0x12fffffffc;
    handle.view.shared->published = before;
    handle.view.shared->sent = before;
    handle.view.shared->overwritten = before;
    pair.first->publish();
    RingWriter writer(handle);
    RingReader reader(*pair.second->find_ring(Side::first, "r"));
    for (std::uint64_t i = 1; i <= 3; ++i) writer.write(bytes_of("x"), i);
    for (std::uint64_t i = 1; i <= 3; ++i) CHECK(reader.read()->sequence == before + i);
    for (std::uint64_t i = 4; i <= 40; ++i) writer.write(bytes_of("x"), i);
    const auto record = reader.read();
    REQUIRE(record);
    CHECK(record->sequence == before + record->stamp_ns);
    CHECK(record->stamp_ns > 30);
    CHECK(reader.read_newest()->sequence == before + 40);
    check_chunk_books(writer.counters(), 0);
}
