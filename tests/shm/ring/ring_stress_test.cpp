// SPDX-License-Identifier: Apache-2.0
// Writer and reader at full speed. Every payload can be checked by itself, so torn and repeated payloads are noticed. All
// messages must be accounted for.
#include "tests/shm/fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// Which lengths a run mixes. in_chunks: every 16th payload is too long for a
/// record and lies in a chunk.
struct Mix {
    const char* name;
    std::size_t max_words, capacity;
    bool newest, in_chunks;
};
constexpr std::size_t max_record = 240, chunk_words = 600;
constexpr Mix mixes[] = {{"one line", 6, 64 * 1024, false, false},
                         {"all lengths in a small ring", 30, 1024, false, false},
                         {"all lengths", 30, 64 * 1024, false, false},
                         {"all lengths, the newest only", 30, 64 * 1024, true, false},
                         {"chunks between", 30, 4096, false, true},
                         {"chunks between, the newest only", 30, 4096, true, true}};

RingOptions options_of(const Mix& mix, Side writer) {
    RingOptions options{.writer = writer, .max_record = max_record, .capacity = mix.capacity};
    if (mix.in_chunks) {
        options.chunk_bytes = 2 * layout::page;
        options.chunks = 4;
    }
    return options;
}

/// Length and every word follow from the number.
std::size_t payload_words(const Mix& mix, std::uint64_t number) {
    const std::uint64_t hash = number * 2654435761U >> 7;
    if (mix.in_chunks && hash % 16 == 0) return max_record / 8 + 1 + hash / 16 % chunk_words;
    return 1 + hash % mix.max_words;
}

void fill(std::span<std::byte> room, std::uint64_t number) {
    for (std::size_t i = 0; i < room.size() / 8; ++i) {
        const std::uint64_t word = number * 31 + i;
        std::memcpy(room.data() + 8 * i, &word, 8);
    }
}

bool intact(const Mix& mix, const Record& record) {
    const std::uint64_t number = record.stamp_ns;
    if (record.bytes.size() != 8 * payload_words(mix, number)) return false;
    for (std::size_t i = 0; i < record.bytes.size() / 8; ++i) {
        std::uint64_t word = 0;
        std::memcpy(&word, record.bytes.data() + 8 * i, 8);
        if (word != number * 31 + i) return false;
    }
    return true;
}

struct Got {
    std::uint64_t messages = 0, bad = 0, out_of_order = 0, gaps = 0;
};

std::uint64_t messages() { return stress(100000, 20'000'000); }

/// Only reached if something hangs, however busy the machine is.
std::uint64_t far_away(std::uint64_t count) {
    return deadline_after(120s + std::chrono::microseconds(std::min<std::uint64_t>(count, 20'000'000) * 50));
}

/// Sends 1..count; the last one until it is accepted, so that the reader knows when to stop.
void send(const Mix& mix, RingWriter& writer, std::uint64_t count) {
    const auto deadline = far_away(count);
    for (std::uint64_t number = 1; number <= count; ++number) {
        const std::size_t bytes = 8 * payload_words(mix, number);
        for (;;) {
            const auto room = writer.reserve(bytes);
            if (room.data() != nullptr) {
                fill(room, number);
                writer.commit(bytes, number);
                break;
            }
            if (number < count || now_ns() > deadline) break;
            std::this_thread::yield();
        }
    }
}

Got receive(const Mix& mix, RingReader& reader, std::uint64_t count) {
    Got got;
    std::uint64_t sequence = 0, stamp = 0;
    const auto deadline = far_away(count);
    while (stamp < count && now_ns() < deadline && !reader.corrupt()) {
        const auto record = mix.newest ? reader.read_newest() : reader.read();
        if (!record) {
            std::this_thread::yield();
            continue;
        }
        ++got.messages;
        if (!intact(mix, *record)) ++got.bad;
        if (record->sequence <= sequence || record->stamp_ns <= stamp) ++got.out_of_order;
        got.gaps += record->sequence - sequence - 1;
        sequence = record->sequence;
        stamp = record->stamp_ns;
    }
    return got;
}

void check(const Got& got, const RingCounters& c, std::uint64_t count) {
    CHECK(got.bad == 0);
    CHECK(got.out_of_order == 0);
    CHECK(got.messages == c.received);
    CHECK(got.gaps == c.overwritten + c.skipped);
    CHECK(c.sent >= count);
    CHECK(c.sent == c.received + c.dropped());
}

} // namespace

TEST_CASE("between two threads no message is torn, duplicated or uncounted") {
    const Mix mix = mixes[GENERATE(range(0, static_cast<int>(std::size(mixes))))];
    Pair pair;
    const std::uint64_t count = messages();
    RingWriter writer(pair.first->add_ring("r", options_of(mix, Side::first)));
    pair.first->publish();
    // Through the writer's addresses: the thread sanitizer knows words by address, and would see no
    // connection between the two mappings that the sides have in one process.
    auto handle = *pair.second->find_ring(Side::first, "r");
    const auto same = *pair.first->find_ring(Side::first, "r");
    handle.view = same.view;
    RingReader reader(handle);
    CAPTURE(mix.name);
    Got got;
    std::thread thread([&] { got = receive(mix, reader, count); });
    send(mix, writer, count);
    thread.join();
    CHECK_FALSE(writer.corrupt());
    CHECK_FALSE(reader.corrupt());
    check(got, writer.counters(), count);
}

TEST_CASE("between two processes no message is torn, duplicated or uncounted") {
    const Mix mix = mixes[GENERATE(1, 4)];
    Link link;
    const std::uint64_t count = messages();
    Child sender([&] {
        auto second = join(link, Side::second);
        RingWriter writer(second->add_ring("r", options_of(mix, Side::second)));
        second->publish();
        send(mix, writer, count);
        return eventually([&] { return second->peer_state() == PeerState::dead; }, 100s) ? 0 : 1;
    });
    std::unique_ptr<Segment> first;
    REQUIRE(eventually([&] { return !link.files().empty(); }));
    first = join(link, Side::first);
    REQUIRE(eventually([&] { return first->peer_published(); }));
    RingReader reader(*first->find_ring(Side::second, "r"));
    const Got got = receive(mix, reader, count);
    CHECK_FALSE(reader.corrupt());
    REQUIRE(eventually([&] { return reader.counters().waiting() == 0; })); // the sender's last counts
    check(got, reader.counters(), count);
    first.reset();
    CHECK(sender.wait() == 0);
    CHECK(link.files().empty());
}

TEST_CASE("a writer killed at any moment leaves whole records only") {
    const Mix mix = mixes[GENERATE(1, 4)];
    for (std::size_t round = 0; round < stress(20, 1000); ++round) {
        Link link;
        auto first = join(link, Side::first);
        Child sender([&] {
            auto second = join(link, Side::second);
            RingWriter writer(second->add_ring("r", options_of(mix, Side::second)));
            second->publish();
            send(mix, writer, ~std::uint64_t{0});
            return 0;
        });
        REQUIRE(eventually([&] { return first->peer_published(); }));
        RingReader reader(*first->find_ring(Side::second, "r"));
        const auto until = deadline_after(std::chrono::microseconds(500 + 37 * round));
        bool whole = true;
        while (now_ns() < until)
            if (const auto record = reader.read()) whole = whole && intact(mix, *record);
        sender.kill_now();
        for (int i = 0; i < 1000; ++i)
            if (const auto record = reader.read()) whole = whole && intact(mix, *record);
        CHECK(whole);
        CHECK_FALSE(reader.corrupt());
        CHECK(reader.empty());
        CHECK(first->peer_state() == PeerState::dead);
    }
}
