// SPDX-License-Identifier: Apache-2.0
// Writer and reader of a ring killed after every one of their stores.
#include "death.hpp"

#include "tests/shm/view_as.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

using Producer = RingProducer<CrashPointAtomics>;
using Consumer = RingConsumer<CrashPointAtomics>;

constexpr std::size_t chunk_bytes = 4096;

/// Every word of message n is n, so a torn one shows.
std::vector<std::uint64_t> message(std::uint64_t number, std::size_t words) {
    return std::vector<std::uint64_t>(words, number);
}
bool whole(const Record& record) {
    for (std::size_t at = 0; at < record.bytes.size(); at += 8)
        if (std::memcmp(record.bytes.data() + at, &record.stamp_ns, 8) != 0) return false;
    return record.bytes.size() % 8 == 0 && !record.bytes.empty();
}

template <class Writer>
bool write(Writer& writer, std::uint64_t number, std::size_t words) {
    const auto payload = message(number, words);
    return writer.write(payload.data(), 8 * words, number);
}

/// Writes like a component: creates the payload in the reserved memory, and commits less than that.
void write_reserved(Producer& producer, std::uint64_t number, std::size_t words, std::size_t used) {
    std::vector<std::uint64_t> scratch(words);
    std::uint64_t* room = scratch.data();
    switch (producer.reserve(8 * words)) {
    case Producer::Reservation::refused:
        return;
    case Producer::Reservation::chunk:
        room = reinterpret_cast<std::uint64_t*>(producer.chunk());
        break;
    case Producer::Reservation::scratch:
        break;
    }
    for (std::size_t i = 0; i < used; ++i)
        CrashPointAtomics::store(room[i], number, std::memory_order_relaxed);
    producer.commit(scratch.data(), 8 * used, number);
}

RingOptions options_of(Side writer) {
    return {.writer = writer, .max_record = 200, .capacity = 1024, .chunk_bytes = chunk_bytes, .chunks = 2};
}

/// The records that were written before, as sizes in words, and how many of them are read again.
struct Before {
    std::vector<std::size_t> written;
    std::size_t read = 0;
};

struct WriterScenario {
    const char* name;
    Before before;
    std::function<void(Producer&, std::uint64_t)> work; // with the first number that is free
    std::size_t messages = 1;
};

std::vector<std::size_t> times(std::size_t count, std::size_t words) {
    return std::vector<std::size_t>(count, words);
}

const std::vector<WriterScenario> writers = {
    {"one line into an empty ring", {}, [](Producer& p, std::uint64_t n) { write(p, n, 1); }},
    {"several lines", {times(2, 3), 0}, [](Producer& p, std::uint64_t n) { write(p, n, 20); }},
    {"across the end", {times(14, 1), 14}, [](Producer& p, std::uint64_t n) { write(p, n, 20); }},
    {"into a full ring", {times(15, 1), 0}, [](Producer& p, std::uint64_t n) { write(p, n, 20); }},
    {"a full ring across the end", {times(3, 25), 1}, [](Producer& p, std::uint64_t n) { write(p, n, 25); }},
    {"reserved and used in part",
     {times(2, 1), 1},
     [](Producer& p, std::uint64_t n) { write_reserved(p, n, 20, 5); }},
    {"reserved across the end",
     {times(14, 1), 14},
     [](Producer& p, std::uint64_t n) { write_reserved(p, n, 25, 2); }},
    {"in a chunk", {times(2, 1), 1}, [](Producer& p, std::uint64_t n) { write_reserved(p, n, 300, 40); }},
    {"more messages than chunks",
     {times(1, 1), 0},
     [](Producer& p, std::uint64_t n) {
         for (std::uint64_t i = 0; i < 4; ++i) write_reserved(p, n + i, 200, 4);
     },
     4},
    {"words that lie elsewhere than the first one",
     {times(3, 2), 1},
     [](Producer& p, std::uint64_t n) {
         write(p, n, 1);
         const auto payload = message(n + 1, 20);
         p.write_words_behind_last(payload[0], &payload[1], 19, n + 1);
     },
     2},
    {"the record whose age is sampled",
     {times(63, 1), 63},
     [](Producer& p, std::uint64_t n) { write(p, n, 1); }},
    {"many one after another",
     {times(5, 2), 3},
     [](Producer& p, std::uint64_t n) {
         for (std::uint64_t i = 0; i < 6; ++i) write(p, n + i, 1 + 3 * i);
     },
     6},
};

/// Brings the ring into the state that `before` describes. Returns the first unused number.
std::uint64_t prepare(const RingView<RealAtomics>& view, RingReader& reader, const Before& before) {
    RingProducer<RealAtomics> producer(view);
    std::uint64_t number = 1;
    std::size_t read = 0;
    for (const std::size_t words : before.written) {
        write(producer, number++, words);
        if (read < before.read && reader.read()) ++read;
    }
    return number;
}

void check_reader_survives(RingReader& reader, const Before& before, std::uint64_t first_of_the_dead,
                           std::size_t messages, bool completed) {
    std::uint64_t last = 0, old = 0, of_the_dead = 0;
    for (int reads = 0; reads < 100; ++reads) {
        const auto record = reader.read();
        if (!record) continue;
        CHECK(whole(*record));
        CHECK(record->stamp_ns > last);
        last = record->stamp_ns;
        ++(last >= first_of_the_dead ? of_the_dead : old);
    }
    CHECK_FALSE(reader.corrupt());
    CHECK(reader.empty());
    CHECK(of_the_dead <= messages);
    CHECK(old <= before.written.size() - before.read);
    // The killed process may have died between a store and its counter, so the counts differ by at most one.
    const RingCounters c = reader.counters();
    const auto off = static_cast<std::int64_t>(c.sent - c.dropped() - c.received);
    CHECK(std::abs(off) <= (completed ? 0 : 1));
    CHECK(c.waiting() <= (completed ? 0U : 1U));
}

} // namespace

TEST_CASE("a writer killed after any of its stores leaves whole records, and the link continues") {
    for (const auto& scenario : writers) {
        PointNames names(std::string("writer, ") + scenario.name);
        for (unsigned k = 1, died = 1; died != 0; ++k) {
            Link link;
            auto survivor = join(link, Side::first, small(arena));
            const auto ring = survivor->add_ring("r", options_of(Side::second));
            survivor->publish();
            RingReader reader(ring);
            const std::uint64_t number = prepare(ring.view, reader, scenario.before);
            Doomed doomed(link, Side::second, k, [&](Segment& segment) {
                Producer producer(view_as<CrashPointAtomics>(segment.find_ring(Side::first, "r")->view));
                scenario.work(producer, number);
            });
            died = doomed.died() ? 1 : 0;
            CAPTURE(scenario.name, k, doomed.point());
            if (died != 0) names.add(doomed.point());
            REQUIRE(doomed.error() == 0);
            check_reader_survives(reader, scenario.before, number, scenario.messages, died == 0);
            check_that_the_link_goes_on(link, survivor);
        }
        CHECK(names.count() > 0);
    }
}

namespace {

struct ReaderScenario {
    const char* name;
    Before before;
    std::function<void(Consumer&)> work;
    std::size_t chunks = 0; // messages in chunks written after them
};

const std::vector<ReaderScenario> readers = {
    {"one line", {times(3, 1), 1}, [](Consumer& c) { c.read(); }},
    {"several lines across the end",
     {times(5, 22), 3},
     [](Consumer& c) {
         c.read();
         c.read();
     }},
    {"the newest", {times(6, 2), 1}, [](Consumer& c) { c.read_newest(); }},
    {"in chunks",
     {times(1, 1), 0},
     [](Consumer& c) {
         for (int i = 0; i < 4; ++i) c.read();
     },
     2},
    {"the record whose age is sampled",
     {times(66, 1), 62},
     [](Consumer& c) {
         c.read();
         c.read();
     }},
};

/// After the reader's death, the writer drops the oldest messages, and its counters stay correct.
void check_writer_survives(RingWriter& writer) {
    const RingCounters before = writer.counters();
    std::size_t accepted = 0;
    for (std::uint64_t number = 1000; number < 1040; ++number) {
        const std::size_t words = number % 8 == 0 ? 300 : 1 + number % 20;
        const auto payload = message(number, words);
        accepted += writer.write(std::as_bytes(std::span(payload)), number) ? 1 : 0;
    }
    CHECK_FALSE(writer.corrupt());
    const RingCounters after = writer.counters();
    CHECK(after.sent - before.sent == 40);
    CHECK(after.refused - before.refused == 40 - accepted);
    CHECK(accepted >= 35); // five need a chunk, and the dead reader may hold all of them
}

} // namespace

TEST_CASE("a reader killed after any of its stores does not stop the writer, and the link continues") {
    for (const auto& scenario : readers) {
        PointNames names(std::string("reader, ") + scenario.name);
        for (unsigned k = 1, died = 1; died != 0; ++k) {
            Link link;
            auto survivor = join(link, Side::first, small(arena));
            const auto ring = survivor->add_ring("r", options_of(Side::first));
            survivor->publish();
            RingWriter writer(ring);
            {
                RingConsumer<RealAtomics> early(ring.view);
                std::uint64_t number = 1;
                for (const std::size_t words : scenario.before.written) {
                    const auto payload = message(number, words);
                    writer.write(std::as_bytes(std::span(payload)), number);
                    if (number++ <= scenario.before.read) early.read();
                }
                for (std::size_t i = 0; i < scenario.chunks; ++i, ++number) {
                    const auto payload = message(number, 300);
                    writer.write(std::as_bytes(std::span(payload)), number);
                }
            }
            Doomed doomed(link, Side::second, k, [&](Segment& segment) {
                Consumer consumer(view_as<CrashPointAtomics>(segment.find_ring(Side::first, "r")->view));
                scenario.work(consumer);
            });
            died = doomed.died() ? 1 : 0;
            CAPTURE(scenario.name, k, doomed.point());
            if (died != 0) names.add(doomed.point());
            REQUIRE(doomed.error() == 0);
            check_writer_survives(writer);
            check_that_the_link_goes_on(link, survivor);
        }
        CHECK(names.count() > 0);
    }
}
