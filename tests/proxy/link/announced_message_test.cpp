// SPDX-License-Identifier: Apache-2.0
// A component that asks whether there is a message and then reads it, while its peer dies or comes back in between.
#include "proxy/link/channel/channel.hpp"
#include "tests/proxy/link/link_side.hpp"
#include "tests/shm/fixture.hpp"

using namespace tandem;
using namespace tandem::link;
using namespace tandem::link::test;

namespace {

/// One generation of a segment with one ring.
struct Generation {
    Generation(ChannelWriter& writer, ChannelReader& reader) {
        shm::RingWriter out(pair.first->add_ring(
            "port", {.max_record = 4096, .capacity = 16384, .chunk_bytes = 131072, .chunks = 3}));
        pair.first->publish();
        writer.bind(nullptr, std::move(out));
        reader.bind(nullptr, shm::RingReader(*pair.second->find_ring(shm::Side::first, "port")));
    }
    shm::RingCounters counters() {
        return shm::RingReader(*pair.second->find_ring(shm::Side::first, "port")).counters();
    }
    shm::test::Pair pair;
};

struct Ends {
    const std::function<void()> wake = [] {};
    ChannelWriter writer{"port", wake};
    ChannelReader reader{wake};

    std::uint64_t unbind() {
        writer.unbind();
        return reader.unbind();
    }
};

} // namespace

TEST_CASE("an announced message is read even after the peer has gone") {
    Ends ends;
    Generation generation(ends.writer, ends.reader);
    for (const double value : {1.0, 2.0, 3.0}) REQUIRE(send(ends.writer, value));
    SECTION("by empty()") { REQUIRE_FALSE(ends.reader.empty()); }
    SECTION("by waiting_locked()") { REQUIRE(ends.reader.waiting_locked() == 3); }
    CHECK(ends.unbind() == 2);
    CHECK_FALSE(ends.reader.empty());
    CHECK(ends.reader.waiting_locked() == 1);
    CHECK(receive(ends.reader) == 1);
    CHECK(ends.reader.empty());
    CHECK(ends.reader.waiting_locked() == 0);
    CHECK_FALSE(receive(ends.reader));
    const auto counters = generation.counters();
    CHECK((counters.sent == 3 && counters.received == 1 && counters.waiting() == 2));
}

TEST_CASE("a message that was not announced is lost with the peer") {
    Ends ends;
    Generation generation(ends.writer, ends.reader);
    REQUIRE(send(ends.writer, 1));
    REQUIRE(receive(ends.reader) == 1);
    REQUIRE(ends.reader.empty());
    REQUIRE(send(ends.writer, 2));
    CHECK(ends.unbind() == 1);
    CHECK(ends.reader.empty());
    CHECK_FALSE(receive(ends.reader));
}

TEST_CASE("a port whose messages were never read counts none as lost with the peer") {
    Ends ends;
    Generation generation(ends.writer, ends.reader);
    for (const double value : {1.0, 2.0}) REQUIRE(send(ends.writer, value));
    CHECK(ends.writer.unbind() == 0);
    CHECK(ends.reader.unbind() == 0);
    CHECK(generation.counters().waiting() == 2);
}

TEST_CASE("an announced message that was too long for the ring is read completely after the peer's end") {
    Ends ends;
    Generation generation(ends.writer, ends.reader);
    REQUIRE(ends.writer.write_sized(100'000, 7, [](std::span<std::byte> room) {
        for (std::size_t i = 0; i < room.size(); ++i) room[i] = static_cast<std::byte>(i % 251);
        return true;
    }));
    REQUIRE_FALSE(ends.reader.empty());
    CHECK(ends.unbind() == 0);
    bool right = false;
    REQUIRE(ends.reader.read(false, [&](const shm::Record& record) {
        right = record.bytes.size() == 100'000 && record.stamp_ns == 7 && record.front != nullptr;
        for (std::size_t i = 0; i < record.bytes.size(); ++i)
            right = right && record.bytes[i] == static_cast<std::byte>(i % 251);
    }));
    CHECK(right);
}

TEST_CASE("an announced message is read before the messages of the next peer, never after them") {
    Ends ends;
    {
        Generation old(ends.writer, ends.reader);
        REQUIRE(send(ends.writer, 1));
        REQUIRE_FALSE(ends.reader.empty());
        ends.unbind();
    }
    Generation next(ends.writer, ends.reader);
    SECTION("before") {
        CHECK(receive(ends.reader) == 1);
        REQUIRE(send(ends.writer, 2));
        CHECK(receive(ends.reader) == 2);
    }
    SECTION("after") {
        REQUIRE(send(ends.writer, 2));
        CHECK(receive(ends.reader) == 2);
    }
    CHECK_FALSE(receive(ends.reader));
}

TEST_CASE("a component that is activated again does not get messages announced before") {
    Ends ends;
    Generation generation(ends.writer, ends.reader);
    REQUIRE(send(ends.writer, 1));
    REQUIRE_FALSE(ends.reader.empty());
    ends.unbind();
    CHECK(ends.reader.discard() == 1);
    CHECK_FALSE(receive(ends.reader));
}
