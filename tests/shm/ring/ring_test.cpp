// SPDX-License-Identifier: Apache-2.0
#include "tests/shm/fixture.hpp"

#include <deque>
#include <random>

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

TEST_CASE("a record arrives with its bytes, sequence number and stamp") {
    RingPair ring({});
    CHECK(ring.reader.empty());
    CHECK_FALSE(ring.reader.read());
    REQUIRE(ring.writer.write(bytes_of("hello"), 17));
    CHECK_FALSE(ring.reader.empty());
    const auto record = ring.reader.read();
    REQUIRE(record);
    CHECK(text_of(record->bytes) == "hello");
    CHECK(record->sequence == 1);
    CHECK(record->stamp_ns == 17);
    CHECK(ring.reader.empty());
    check_books(ring.writer.counters(), 0);
    CHECK(ring.reader.counters().bytes_sent == 5);
    CHECK(ring.reader.counters().bytes_received == 5);
}

TEST_CASE("a rehearsal publishes nothing, counts nothing and does not change the next message") {
    RingPair ring({.max_record = 200, .capacity = 512});
    ring.writer.rehearse_publish(16);
    CHECK(ring.reader.empty());
    for (std::size_t round = 0; round < 100; ++round) {
        const std::string text(round % 201, static_cast<char>('a' + round % 26));
        ring.writer.rehearse_publish(10);
        REQUIRE(ring.reader.empty());
        REQUIRE(ring.writer.write(bytes_of(text), round));
        ring.writer.rehearse_publish(10);
        const auto record = ring.reader.read();
        REQUIRE(record);
        REQUIRE(text_of(record->bytes) == text);
        REQUIRE(record->sequence == round + 1);
    }
    CHECK(ring.writer.counters().sent == 100);
    check_books(ring.writer.counters(), 0);
}

TEST_CASE(
    "a first word and words at another address become one record wherever they fit after the last one") {
    RingPair ring({.max_record = 200, .capacity = 1024});
    std::size_t published = 0;
    for (std::uint64_t round = 1; round < 200; ++round) {
        std::vector<std::uint64_t> words(1 + round % 25);
        for (std::size_t i = 0; i < words.size(); ++i) words[i] = round * 1000 + i;
        const auto bytes = std::as_bytes(std::span(words));
        if (ring.writer.try_publish_words(words[0], words.data() + 1, words.size() - 1, round))
            ++published;
        else
            REQUIRE(ring.writer.write(bytes, round)); // nothing has happened
        const auto record = ring.reader.read();
        REQUIRE(record);
        REQUIRE(std::equal(bytes.begin(), bytes.end(), record->bytes.begin(), record->bytes.end()));
        REQUIRE(record->sequence == round);
        REQUIRE(record->stamp_ns == round);
        REQUIRE(ring.reader.empty());
    }
    CHECK(published > 100);
    check_books(ring.writer.counters(), 0);
}

TEST_CASE("the last record can be read once more without taking or counting anything") {
    RingPair ring({.max_record = 200, .capacity = 512});
    CHECK_FALSE(ring.reader.rehearse_read());
    for (std::size_t round = 1; round < 100; ++round) {
        const std::string text(round, static_cast<char>('a' + round % 26));
        REQUIRE(ring.writer.write(bytes_of(text), round));
        if (round > 1)
            REQUIRE(ring.reader.rehearse_read()->bytes.size() == round - 1); // the new one stays where it is
        REQUIRE(text_of(ring.reader.read()->bytes) == text);
        REQUIRE(text_of(ring.reader.rehearse_read()->bytes) == text);
        REQUIRE(ring.reader.empty());
    }
    CHECK(ring.reader.counters().received == 99);
    check_books(ring.writer.counters(), 0);
}

TEST_CASE("a message created in the writer's memory arrives, and bytes before it stay private") {
    RingPair ring({.max_record = 200, .capacity = 512});
    for (std::size_t length = 0; length <= 200; ++length) {
        const std::string text(length, static_cast<char>('a' + length % 26));
        const auto room = ring.writer.scratch();
        REQUIRE(room.size() == 200);
        std::memset(room.data() - payload_front, 0xee, payload_front);
        std::memcpy(room.data(), text.data(), length);
        REQUIRE(ring.writer.write(room.first(length), length));
        const auto record = ring.reader.read();
        REQUIRE(record);
        REQUIRE(record->front == record->bytes.data() - payload_front);
        std::memset(record->front, 0xee, payload_front);
        REQUIRE(text_of(record->bytes) == text);
    }
    check_books(ring.writer.counters(), 0);
}

TEST_CASE("records of all lengths, including zero, pass through a small ring repeatedly") {
    RingPair ring({.max_record = 200, .capacity = 512});
    for (std::size_t round = 0; round < 2000; ++round) {
        const std::string text(round % 201, static_cast<char>('a' + round % 26));
        REQUIRE(ring.writer.write(bytes_of(text), round));
        const auto record = ring.reader.read();
        REQUIRE(record);
        REQUIRE(text_of(record->bytes) == text);
        REQUIRE(record->sequence == round + 1);
    }
    check_books(ring.writer.counters(), 0);
}

TEST_CASE("a reservation that is not committed is not visible and costs nothing") {
    RingPair ring({});
    REQUIRE(ring.writer.reserve(100).size() == 100);
    CHECK(ring.reader.empty());
    ring.writer.cancel_reservation();
    auto room = ring.writer.reserve(1000);
    std::memcpy(room.data(), "abc", 3);
    ring.writer.commit(3, 0);
    CHECK(text_of(ring.reader.read()->bytes) == "abc");
    CHECK(ring.writer.counters().sent == 1);
}

TEST_CASE("committing more than was reserved is a programming error") {
    RingPair ring({});
    CHECK_THROWS_AS(ring.writer.commit(1, 0), std::logic_error);
    ring.writer.reserve(4);
    CHECK_THROWS_AS(ring.writer.commit(5, 0), std::logic_error);
}

TEST_CASE("a record that is too long for the ring is refused and counted") {
    RingPair ring({.max_record = 64});
    CHECK(ring.writer.reserve(65).data() == nullptr);
    CHECK(ring.writer.counters().refused == 1);
    check_books(ring.writer.counters(), 0);
}

TEST_CASE("a full ring keeps the newest records, and the reader sees the gap in the sequence") {
    RingPair ring({.max_record = 100, .capacity = 512});
    for (std::uint64_t i = 1; i <= 50; ++i) ring.writer.write(bytes_of(std::string(40, 'x')), i);
    const auto dropped = ring.writer.counters().overwritten;
    CHECK(dropped >= 40);
    check_books(ring.writer.counters(), 50 - dropped);
    std::uint64_t expected = dropped + 1;
    while (const auto record = ring.reader.read()) CHECK(record->sequence == expected++);
    CHECK(expected == 51);
    check_books(ring.writer.counters(), 0);
}

TEST_CASE("read_newest() skips older records") {
    RingPair ring({.max_record = 100, .capacity = 512});
    for (std::uint64_t i = 1; i <= 5; ++i) ring.writer.write(bytes_of(std::string(i, 'x')), i);
    CHECK(ring.reader.read_newest()->stamp_ns == 5);
    CHECK_FALSE(ring.reader.read_newest());
    ring.writer.write(bytes_of("y"), 6);
    CHECK(ring.reader.read()->stamp_ns == 6);
    check_books(ring.writer.counters(), 0);
    CHECK(ring.writer.counters().skipped == 4);
}

TEST_CASE("a reader with a depth gets what a queue of that length would hold, whatever was written between "
          "its reads") {
    const std::uint64_t depth = GENERATE(1, 2, 4, 15);
    RingPair ring({.max_record = 200, .capacity = 32768, .chunk_bytes = 4096, .chunks = 60});
    ring.reader.set_depth(depth);
    std::deque<std::string> queue;
    std::uint64_t sent = 0, received = 0;
    std::minstd_rand random(static_cast<unsigned>(depth));
    for (int round = 0; round < 500; ++round) {
        for (auto writes = random() % (round % 3 == 0 ? 30 : 3); writes > 0; --writes) {
            const std::size_t length = random() % 20 == 0 ? 300 + random() % 100 : random() % 201;
            queue.emplace_back(length, static_cast<char>('a' + ++sent % 26));
            REQUIRE(ring.writer.write(bytes_of(queue.back()), sent));
            if (queue.size() > depth) queue.pop_front();
        }
        REQUIRE(ring.reader.waiting() == queue.size());
        check_books(ring.writer.counters(), queue.size());
        for (auto reads = random() % 4; reads > 0; --reads) {
            const auto* const record = ring.reader.read();
            REQUIRE((record != nullptr) == !queue.empty());
            if (!record) break;
            REQUIRE(text_of(record->bytes) == queue.front());
            queue.pop_front();
            ++received;
        }
    }
    const auto counters = ring.reader.counters();
    CHECK(counters.received == received);
    CHECK(counters.overwritten + counters.refused == 0);
    CHECK(counters.lost() == (depth == 1 ? 0 : counters.skipped)); // the newest one is all that was wanted
    CHECK_FALSE(ring.reader.corrupt());
}

TEST_CASE("a reader whose depth was removed reads all waiting records") {
    RingPair ring({.max_record = 100, .capacity = 1024});
    for (const std::uint64_t depth : {3, 0, 1000}) { // the ring holds less than the last one
        ring.reader.set_depth(depth);
        for (std::uint64_t i = 1; i <= 10; ++i) ring.writer.write(bytes_of("x"), i);
        for (std::uint64_t i = depth == 3 ? 8 : 1; i <= 10; ++i) CHECK(ring.reader.read()->stamp_ns == i);
        CHECK_FALSE(ring.reader.read());
        CHECK(ring.reader.counters().depth == (depth == 3 ? 3 : 0));
    }
    CHECK(ring.reader.counters().skipped == 7);
}

TEST_CASE("the last record, of any length, can be read again until the next one is read") {
    RingPair ring({.max_record = 100, .capacity = 1024, .chunk_bytes = 4096, .chunks = 2});
    CHECK_FALSE(ring.reader.again());
    for (const std::size_t length : {5, 3000, 0}) {
        ring.writer.write(bytes_of(std::string(length, 'x')), length);
        REQUIRE(ring.reader.read());
        CHECK_FALSE(ring.reader.read());
        REQUIRE(ring.reader.again());
        CHECK(ring.reader.again()->bytes.size() == length);
    }
    CHECK(ring.reader.counters().received == 3);
}

TEST_CASE("a record that was read does not change, however much is written afterwards") {
    RingPair ring({.max_record = 100, .capacity = 512});
    ring.writer.write(bytes_of("first"), 0);
    const auto record = ring.reader.read();
    for (int i = 0; i < 100; ++i) ring.writer.write(bytes_of(std::string(50, 'z')), 0);
    CHECK(text_of(record->bytes) == "first");
}

TEST_CASE("a new reader or writer continues where the last one stopped") {
    RingPair ring({});
    for (int i = 1; i <= 4; ++i) ring.writer.write(bytes_of(std::to_string(i)), 0);
    ring.reader.read();
    RingReader reader(*ring.second->find_ring(Side::first, "r"));
    RingWriter writer(*ring.first->find_ring(Side::first, "r"));
    CHECK(text_of(reader.read()->bytes) == "2");
    writer.write(bytes_of("5"), 0);
    CHECK(reader.read()->sequence == 3);
    CHECK(reader.read()->sequence == 4);
    CHECK(text_of(reader.read()->bytes) == "5");
    check_books(writer.counters(), 0);
    CHECK(writer.counters().received == 5);
}

TEST_CASE("either side may write a ring in either arena") {
    Pair pair;
    RingReader reader(pair.first->add_ring("back", {.writer = Side::second}));
    pair.first->publish();
    RingWriter writer(*pair.second->find_ring(Side::first, "back"));
    writer.write(bytes_of("hi"), 0);
    CHECK(text_of(reader.read()->bytes) == "hi");
    CHECK_THROWS_AS(RingWriter(*pair.first->find_ring(Side::first, "back")), Error);
    CHECK_THROWS_AS(RingReader(*pair.second->find_ring(Side::first, "back")), Error);
}

TEST_CASE("ring objects may outlive their segment") {
    RingPair ring({});
    ring.first.reset();
    ring.second.reset();
    CHECK(ring.writer.write(bytes_of("x"), 0));
    CHECK(ring.reader.read());
}

TEST_CASE("the age is measured for the first record, each 64th, a requested one, and after a rehearsal if "
          "none was measured for a fifth of a second") {
    RingPair ring({});
    const RingHandle handle = *ring.second->find_ring(Side::first, "r");
    const auto pass_one_on = [&] {
        ring.writer.write(bytes_of("hello"), 0);
        const auto record = ring.reader.read();
        REQUIRE(record);
        CHECK(text_of(record->bytes) == "hello");
        std::uint64_t ages = 0;
        for (const auto& count : handle.view.shared->age.counts) ages += count.load();
        return ages;
    };
    CHECK(pass_one_on() == 1);
    for (int sequence = 2; sequence <= 63; ++sequence) CHECK(pass_one_on() == 1);
    CHECK(pass_one_on() == 2);
    ring.writer.sample_next();
    CHECK(pass_one_on() == 3);
    CHECK(pass_one_on() == 3);
    std::this_thread::sleep_for(250ms);
    CHECK(pass_one_on() == 3); // which does not look at a clock
    ring.writer.rehearse_publish(5);
    CHECK(pass_one_on() == 4);
    CHECK(pass_one_on() == 4);
    CHECK(ring.reader.counters().received == 69);
}
