// SPDX-License-Identifier: Apache-2.0
#include "tests/shm/fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// A ring written by first and read by second.
struct RingPair : Pair {
    explicit RingPair(RingOptions options)
        : writer(first->add_ring("r", options)),
          reader((first->publish(), *second->find_ring(Side::first, "r"))) {}
    RingWriter writer;
    RingReader reader;
};

void check_books(const RingCounters& c, std::uint64_t waiting) {
    CHECK(c.sent == c.received + c.dropped() + waiting);
    CHECK(c.waiting() == waiting);
}

} // namespace

TEST_CASE("a record arrives with its bytes sequence stamp and tag under every policy") {
    for (const auto policy : all_policies) {
        RingPair ring({.policy = policy});
        CHECK(ring.reader.empty());
        CHECK_FALSE(ring.reader.read());
        REQUIRE(ring.writer.write(bytes_of("hello"), 17, 99));
        CHECK_FALSE(ring.reader.empty());
        const auto record = ring.reader.read();
        REQUIRE(record);
        CHECK(text_of(record->bytes) == "hello");
        CHECK(record->sequence == 1);
        CHECK(record->stamp_ns == 17);
        CHECK(record->tag == 99);
        CHECK(ring.reader.empty());
        check_books(ring.writer.counters(), 0);
        CHECK(ring.reader.counters().bytes_sent == 5);
        CHECK(ring.reader.counters().bytes_received == 5);
    }
}

TEST_CASE("records of all lengths including none go through a small ring again and again") {
    for (const auto policy : all_policies) {
        RingPair ring({.policy = policy, .max_record = 200, .capacity = 512});
        for (std::size_t round = 0; round < 2000; ++round) {
            const std::string text(round % 201, static_cast<char>('a' + round % 26));
            REQUIRE(ring.writer.write(bytes_of(text), round, 0));
            const auto record = ring.reader.read();
            REQUIRE(record);
            REQUIRE(text_of(record->bytes) == text);
            REQUIRE(record->sequence == round + 1);
        }
        check_books(ring.writer.counters(), 0);
    }
}

TEST_CASE("what is reserved but not committed is not visible and costs nothing") {
    for (const auto policy : all_policies) {
        RingPair ring({.policy = policy});
        REQUIRE(ring.writer.reserve(100).size() == 100);
        CHECK(ring.reader.empty());
        ring.writer.abandon();
        auto room = ring.writer.reserve(1000);
        std::memcpy(room.data(), "abc", 3);
        ring.writer.commit(3, 0, 0);
        CHECK(text_of(ring.reader.read()->bytes) == "abc");
        CHECK(ring.writer.counters().sent == 1);
    }
}

TEST_CASE("committing more than was reserved is a programming error") {
    RingPair ring({});
    CHECK_THROWS_AS(ring.writer.commit(1, 0, 0), std::logic_error);
    ring.writer.reserve(4);
    CHECK_THROWS_AS(ring.writer.commit(5, 0, 0), std::logic_error);
}

TEST_CASE("a record longer than the ring takes is refused and counted") {
    for (const auto policy : all_policies) {
        RingPair ring({.policy = policy, .max_record = 64});
        CHECK(ring.writer.reserve(65).data() == nullptr);
        CHECK(ring.writer.counters().refused == 1);
        check_books(ring.writer.counters(), 0);
    }
}

TEST_CASE("drop_oldest keeps the newest that fit and the reader sees the gap in the sequence") {
    RingPair ring({.policy = RingPolicy::drop_oldest, .max_record = 100, .capacity = 512});
    for (std::uint64_t i = 1; i <= 50; ++i) ring.writer.write(bytes_of(std::string(40, 'x')), i, 0);
    const auto dropped = ring.writer.counters().overwritten;
    CHECK(dropped >= 40);
    check_books(ring.writer.counters(), 50 - dropped);
    std::uint64_t expected = dropped + 1;
    while (const auto record = ring.reader.read()) CHECK(record->sequence == expected++);
    CHECK(expected == 51);
    check_books(ring.writer.counters(), 0);
}

TEST_CASE("latest_only hands out the newest and counts the others as dropped") {
    RingPair ring({.policy = RingPolicy::latest_only});
    for (std::uint64_t i = 1; i <= 10; ++i) ring.writer.write(bytes_of(std::to_string(i)), i, 0);
    CHECK(text_of(ring.reader.read()->bytes) == "10");
    CHECK_FALSE(ring.reader.read());
    CHECK(ring.writer.counters().received == 1);
    CHECK(ring.writer.counters().skipped == 9);
    check_books(ring.writer.counters(), 0);
}

TEST_CASE("read_newest() skips what is older under every policy") {
    for (const auto policy : all_policies) {
        RingPair ring({.policy = policy, .max_record = 100, .capacity = 512});
        for (std::uint64_t i = 1; i <= 5; ++i) ring.writer.write(bytes_of(std::string(i, 'x')), i, 0);
        CHECK(ring.reader.read_newest()->stamp_ns == 5);
        CHECK_FALSE(ring.reader.read_newest());
        ring.writer.write(bytes_of("y"), 6, 0);
        CHECK(ring.reader.read()->stamp_ns == 6);
        check_books(ring.writer.counters(), 0);
        CHECK(ring.writer.counters().skipped == 4);
    }
}

TEST_CASE("reject refuses the newest when full and goes on when there is room again") {
    RingPair ring({.policy = RingPolicy::reject, .max_record = 100, .capacity = 512});
    std::uint64_t accepted = 0;
    for (int i = 0; i < 50; ++i) accepted += ring.writer.write(bytes_of(std::string(40, 'x')), 0, 0) ? 1 : 0;
    CHECK(accepted == 7); // 512 / 64, and one line that is always free
    CHECK(ring.writer.counters().refused == 43);
    check_books(ring.writer.counters(), 7);
    REQUIRE(ring.reader.read());
    CHECK(ring.writer.write(bytes_of("again"), 0, 0));
    std::uint64_t sequence = 1;
    while (const auto record = ring.reader.read()) CHECK(record->sequence == ++sequence);
    CHECK(sequence == 8);
}

TEST_CASE("wait refuses after its bound and gets through when the reader makes room") {
    RingPair ring({.policy = RingPolicy::wait, .max_record = 170, .capacity = 512, .wait = 2ms});
    const std::string text(170, 'x');
    REQUIRE(ring.writer.write(bytes_of(text), 1, 0));
    REQUIRE(ring.writer.write(bytes_of(text), 2, 0));
    const auto before = now_ns();
    CHECK_FALSE(ring.writer.write(bytes_of(text), 3, 0));
    CHECK(now_ns() - before >= 2'000'000);

    RingPair patient({.policy = RingPolicy::wait, .max_record = 170, .capacity = 512, .wait = 10s});
    bool in_order = true;
    std::thread reader([&] {
        for (std::uint64_t stamp = 1; stamp <= 100;) {
            const auto record = patient.reader.read();
            if (!record) std::this_thread::yield();
            if (record) in_order = in_order && record->stamp_ns == stamp++;
            if (stamp % 20 == 0) std::this_thread::sleep_for(200us);
        }
    });
    for (std::uint64_t stamp = 1; stamp <= 100; ++stamp)
        CHECK(patient.writer.write(bytes_of(text), stamp, 0));
    reader.join();
    CHECK(in_order);
    check_books(patient.writer.counters(), 0);
}

TEST_CASE("a record stays as it was read however much is written behind it") {
    RingPair ring({.policy = RingPolicy::drop_oldest, .max_record = 100, .capacity = 512});
    ring.writer.write(bytes_of("first"), 0, 0);
    const auto record = ring.reader.read();
    for (int i = 0; i < 100; ++i) ring.writer.write(bytes_of(std::string(50, 'z')), 0, 0);
    CHECK(text_of(record->bytes) == "first");
}

TEST_CASE("a reader or writer made anew goes on where the last one stopped") {
    RingPair ring({.policy = RingPolicy::drop_oldest});
    for (int i = 1; i <= 4; ++i) ring.writer.write(bytes_of(std::to_string(i)), 0, 0);
    ring.reader.read();
    RingReader reader(*ring.second->find_ring(Side::first, "r"));
    RingWriter writer(*ring.first->find_ring(Side::first, "r"));
    CHECK(text_of(reader.read()->bytes) == "2");
    writer.write(bytes_of("5"), 0, 0);
    CHECK(reader.read()->sequence == 3);
    CHECK(reader.read()->sequence == 4);
    CHECK(text_of(reader.read()->bytes) == "5");
    check_books(writer.counters(), 0);
    CHECK(writer.counters().received == 5);
}

TEST_CASE("either side may write a ring that stands in either half") {
    Pair pair;
    RingReader reader(pair.first->add_ring("back", {.writer = Side::second}));
    pair.first->publish();
    RingWriter writer(*pair.second->find_ring(Side::first, "back"));
    writer.write(bytes_of("hi"), 0, 0);
    CHECK(text_of(reader.read()->bytes) == "hi");
    CHECK_THROWS_AS(RingWriter(*pair.first->find_ring(Side::first, "back")), Error);
    CHECK_THROWS_AS(RingReader(*pair.second->find_ring(Side::first, "back")), Error);
}

TEST_CASE("ring objects may outlive their segment") {
    RingPair ring({});
    ring.first.reset();
    ring.second.reset();
    CHECK(ring.writer.write(bytes_of("x"), 0, 0));
    CHECK(ring.reader.read());
}
