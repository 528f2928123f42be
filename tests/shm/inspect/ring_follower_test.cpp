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
    // There are four chunks for ten long messages without a reader, so only the newest messages still have their content.
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
    SECTION("a head that is not a multiple of a line") { shared.head = 7; }
    SECTION("a head that has moved backwards") {
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
    SECTION("a record that is longer than what its writer has published") {
        RealAtomics::store(*ring.handle.view.cell(0), CommitWord::pack(layout::RecordKind::data, 100, 1),
                           std::memory_order_release);
        shared.head = layout::line;
        shared.newest = 0;
    }
    SECTION("a file that ends") {
        install_truncation_guard();
        std::filesystem::resize_file(seen->segment.path, 100);
    }
    CHECK_FALSE(follower.poll(ignore));
    CHECK(follower.damaged());
    CHECK_FALSE(follower.poll(ignore));
}

TEST_CASE("a follower that makes no progress does not ask to be called again") {
    FollowedRing ring({.max_record = 100, .capacity = 1024});
    RingFollower follower = ring.follow();
    const auto ignore = [](const FollowedRecord&) {};
    ring.writer.write(payload_of(1, 48), 0);
    ring.handle.view.shared->write_limit = ~std::uint64_t{0}; // no copy counts as whole
    CHECK_FALSE(follower.poll(ignore));
    CHECK_FALSE(follower.poll(ignore));
    CHECK(follower.delivered() == 0);
}

TEST_CASE("one poll of a follower ends, however much its writer claims to have written") {
    FollowedRing ring({.max_record = 100, .capacity = 1024});
    RingFollower follower = ring.follow();
    auto& shared = *ring.handle.view.shared;
    shared.head = ~std::uint64_t{0} / layout::line * layout::line;
    shared.write_limit = 0;
    // Padding up to the end of the ring, wherever the follower is.
    for (std::uint64_t at = 0; at < 1024; at += layout::line)
        RealAtomics::store(*ring.handle.view.cell(at), CommitWord::pack(layout::RecordKind::padding, 0, 1),
                           std::memory_order_release);
    for (int polls = 0; polls < 4; ++polls) follower.poll([](const FollowedRecord&) {}, 64 * 1024);
    CHECK(follower.delivered() == 0);
}

TEST_CASE("a follower copies no longer messages than its file has memory for") {
    JoinOptions options = small(512 * 1024);
    options.sparse = true;
    options.chunk_pool_bytes = std::size_t{2} << 30;
    const Link link;
    const auto first = join(link, Side::first, options);
    const auto handle = first->add_ring(
        "data", {.max_record = 100, .capacity = 1024, .chunk_bytes = std::size_t{1} << 29, .chunks = 2});
    first->publish();
    const auto seen = observe(link.name);
    REQUIRE(seen);
    REQUIRE(seen->rings.at(0).damage.empty());
    const auto memory = std::make_shared<CopyMemory>();
    RingFollower follower(std::make_shared<const ReadOnlySnapshot>(seen->segment.path), seen->rings[0],
                          RingFollower::Begin::newest, memory);
    RingWriter writer(handle);
    writer.write(payload_of(1, 5000), 0);
    // The record claims a whole chunk, most of which has no memory.
    RealAtomics::store(*handle.view.cell(layout::record_header + word_bytes), std::uint64_t{1} << 29,
                       std::memory_order_release);
    CHECK_FALSE(follower.poll([](const FollowedRecord&) {}));
    CHECK(follower.damaged());
    CHECK(memory->chunk.size() * word_bytes <= seen->segment.memory_bytes + 8192);
}

TEST_CASE("a follower finds chunks that begin one page after an aligned end of their words") {
    // Blobs before the ring move the end of the chunks' words to the beginning of a page.
    FollowedRing probe({.max_record = 100, .capacity = 1024, .chunk_bytes = 8192, .chunks = 4}, 1 << 20);
    const auto end_of_words = [](const RingHandle& ring) {
        return reinterpret_cast<std::uintptr_t>(ring.view.chunk_words + ring.view.chunk_count);
    };
    Pair pair(small(1 << 20));
    const std::uint64_t missing = layout::page - end_of_words(probe.handle) % layout::page;
    pair.first->add_blob("front", missing);
    const auto handle =
        pair.first->add_ring("data", {.max_record = 100, .capacity = 1024, .chunk_bytes = 8192, .chunks = 4});
    REQUIRE(end_of_words(handle) % layout::page == 0);
    pair.first->publish();
    const auto seen = observe(pair.link.name);
    REQUIRE(seen);
    RingFollower follower(std::make_shared<const ReadOnlySnapshot>(seen->segment.path), seen->rings.at(0));
    RingWriter writer(handle);
    writer.write(payload_of(1, 5000), 0);
    follower.poll([](const FollowedRecord& record) { CHECK(holds(record.bytes, 1)); });
    CHECK(follower.delivered() == 1);
}
