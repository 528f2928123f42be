// SPDX-License-Identifier: Apache-2.0
#include "shm/inspect/ring_follower.hpp"

#include "shm/inspect/read_only_snapshot.hpp"
#include "shm/ring/ring_reader.hpp"
#include "shm/ring/ring_writer.hpp"
#include "shm/segment/truncation_guard.hpp"
#include "tests/shm/fixture.hpp"

#include <atomic>
#include <cstring>
#include <fstream>
#include <thread>

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// A ring of the first side, and what an observer needs to follow it.
struct FollowedRing {
    explicit FollowedRing(const RingOptions& options, std::size_t arena = 512 * 1024)
        : pair(small(arena)), handle(pair.first->add_ring("data", options)), writer(handle) {
        pair.first->publish();
    }
    RingFollower follow(RingFollower::Begin begin = RingFollower::Begin::newest) const {
        const auto seen = observe(pair.link.name);
        REQUIRE(seen);
        return {std::make_shared<const ReadOnlySnapshot>(seen->segment.path), seen->rings.at(0), begin};
    }
    RingReader reader() const { return RingReader(*pair.second->find_ring(Side::first, "data")); }

    Pair pair;
    RingHandle handle;
    RingWriter writer;
};

std::vector<std::byte> payload_of(std::uint64_t number, std::size_t bytes) {
    std::vector<std::byte> payload(bytes);
    for (std::size_t i = 0; i < bytes; ++i) payload[i] = static_cast<std::byte>(number * 31 + i);
    return payload;
}

bool holds(std::span<const std::byte> bytes, std::uint64_t number) {
    const auto wanted = payload_of(number, bytes.size());
    return std::equal(bytes.begin(), bytes.end(), wanted.begin());
}

} // namespace

TEST_CASE("a follower gets each message, whether or not the reader reads it") {
    FollowedRing ring({.max_record = 200, .capacity = 4096});
    RingReader reader = ring.reader();
    ring.writer.write(payload_of(1, 40), 11);
    RingFollower newest = ring.follow(), oldest = ring.follow(RingFollower::Begin::oldest);
    std::vector<std::uint64_t> sequences;
    const auto collect = [&](const FollowedRecord& record) {
        CHECK(holds(record.bytes, record.sequence));
        CHECK(record.stamp == 10 + record.sequence);
        sequences.push_back(record.sequence);
    };
    CHECK_FALSE(newest.poll(collect));
    CHECK(sequences.empty());
    CHECK_FALSE(oldest.poll(collect));
    CHECK(sequences == std::vector<std::uint64_t>{1});
    sequences.clear();
    // More than one turn of the ring, with records of many sizes and so with padding.
    for (std::uint64_t number = 2; number <= 300; ++number) {
        ring.writer.write(payload_of(number, number % 201), 10 + number);
        if (number % 3 == 0) {
            while (reader.read()) {
            }
        }
        CHECK_FALSE(newest.poll(collect));
    }
    CHECK(sequences.size() == 299);
    CHECK(sequences.back() == 300);
    CHECK(newest.delivered() == 299);
    CHECK(newest.lost() == 0);
    CHECK_FALSE(newest.damaged());
}

TEST_CASE("a follower that is overtaken counts its losses and continues") {
    FollowedRing ring({.max_record = 100, .capacity = 1024});
    RingFollower follower = ring.follow();
    std::uint64_t last = 0;
    const auto check = [&](const FollowedRecord& record) {
        CHECK(holds(record.bytes, record.sequence));
        last = record.sequence;
    };
    ring.writer.write(payload_of(1, 48), 0);
    follower.poll(check);
    for (std::uint64_t number = 2; number <= 1000; ++number) ring.writer.write(payload_of(number, 48), 0);
    follower.poll(check);
    CHECK(last == 1000);
    CHECK(follower.delivered() + follower.lost() == 1000);
    CHECK(follower.lost() > 900);
}

TEST_CASE("a follower that looks for the next record misses none, and notices after a while that it was "
          "overtaken") {
    FollowedRing ring({.max_record = 100, .capacity = 1024});
    RingReader reader = ring.reader();
    RingFollower follower = ring.follow();
    const auto ignore = [](const FollowedRecord&) {};
    for (std::uint64_t number = 1; number <= 100; ++number) {
        CHECK_FALSE(follower.may_have_come());
        ring.writer.write(payload_of(number, number % 101), 0);
        reader.read();
        CHECK(follower.may_have_come());
        follower.poll(ignore);
    }
    CHECK(follower.delivered() == 100);
    // Round the ring to where it was, so that the next record will begin at the same place.
    follower.poll(ignore);
    const auto end = [&] { return ring.handle.view.shared->head.load() % 1024; };
    for (const auto before = end(); ring.writer.write(payload_of(101, 10), 0) && end() != before;) continue;
    int looks = 1;
    while (!follower.may_have_come() && looks < 1000) ++looks;
    CHECK(looks > 1);
    CHECK(looks <= 64);
    follower.poll(ignore);
    CHECK(follower.delivered() + follower.lost() == ring.writer.counters().sent);
    CHECK(follower.lost() > 0);
}

TEST_CASE("a follower copies long messages from their chunks") {
    FollowedRing ring({.max_record = 100, .capacity = 1024, .chunk_bytes = 8192, .chunks = 4}, 1 << 20);
    RingReader reader = ring.reader();
    RingFollower follower = ring.follow();
    std::vector<std::size_t> lengths;
    const auto check = [&](const FollowedRecord& record) {
        CHECK(holds(record.bytes, record.sequence));
        lengths.push_back(record.bytes.size());
    };
    for (std::uint64_t number = 1; number <= 20; ++number) {
        ring.writer.write(payload_of(number, number % 2 == 0 ? 5000 + number : 10), 0);
        reader.read();
        follower.poll(check);
    }
    CHECK(lengths.size() == 20);
    CHECK(lengths.back() == 5020);
    // Four chunks for ten long messages that nobody reads: the content of all but the newest is gone.
    for (std::uint64_t number = 21; number <= 30; ++number) ring.writer.write(payload_of(number, 6000), 0);
    follower.poll(check);
    CHECK(follower.delivered() + follower.lost() == 30);
    CHECK(follower.lost() > 0);
    CHECK(lengths.back() == 6000);
}

TEST_CASE("no message of a follower is torn while the writer overtakes it") {
    FollowedRing ring({.max_record = 500, .capacity = 2048, .chunk_bytes = 4096, .chunks = 2}, 1 << 20);
    RingFollower follower = ring.follow();
    const std::uint64_t messages = 20'000;
    std::atomic<bool> done = false;
    std::thread writing([&] {
        for (std::uint64_t number = 1; number <= messages; ++number)
            ring.writer.write(payload_of(number, number % 97 == 0 ? 3000 : number * 7 % 500), 0);
        done = true;
    });
    RingReader reader = ring.reader(); // takes chunks off the ring, so that they are used again
    std::thread reading([&] {
        while (!done) reader.read();
    });
    std::uint64_t torn = 0;
    const auto check = [&](const FollowedRecord& record) {
        torn += holds(record.bytes, record.sequence) ? 0 : 1;
    };
    while (!done) follower.poll(check);
    writing.join();
    reading.join();
    follower.poll(check);
    CHECK(torn == 0);
    CHECK(follower.delivered() + follower.lost() == messages);
    CHECK(follower.delivered() > 0);
    CHECK_FALSE(follower.damaged());
}

TEST_CASE("a follower ends at bytes that no writer stores") {
    FollowedRing ring({.max_record = 100, .capacity = 1024});
    const auto seen = observe(ring.pair.link.name);
    REQUIRE(seen);
    const auto file = std::make_shared<const ReadOnlySnapshot>(seen->segment.path);
    RingFollower follower(file, seen->rings.at(0));
    auto& shared = *ring.handle.view.shared;
    const auto ignore = [](const FollowedRecord&) {};
    SECTION("a head that is no multiple of a line") { shared.head = 7; }
    SECTION("a head in front of what it was") {
        ring.writer.write(payload_of(1, 48), 0);
        follower.poll(ignore);
        shared.head = 0;
    }
    SECTION("a record longer than the ring's longest") {
        RealAtomics::store(*ring.handle.view.cell(0), CommitWord::pack(layout::RecordKind::data, 1000, 1),
                           std::memory_order_release);
        shared.head = layout::line;
    }
    SECTION("a chunk of a ring without chunks") {
        RealAtomics::store(*ring.handle.view.cell(0), CommitWord::pack(layout::RecordKind::chunk, 16, 1),
                           std::memory_order_release);
        shared.head = layout::line;
    }
    SECTION("a file that ends") {
        install_truncation_guard();
        std::filesystem::resize_file(seen->segment.path, 100);
    }
    CHECK_FALSE(follower.poll(ignore));
    CHECK(follower.damaged());
    CHECK_FALSE(follower.poll(ignore));
}
