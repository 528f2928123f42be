// SPDX-License-Identifier: Apache-2.0
// An RTC writes through a LinkBuffer, and another one reads, message by message in place.
#include "proxy/interceptor/data/link_buffer.hpp"
#include "tests/proxy/interceptor/orb.hpp"
#include "tests/shm/fixture.hpp"

#include <rtm/CORBA_CdrMemoryStream.h>
#include <rtm/CdrRingBuffer.h>

using namespace tandem;
using namespace tandem::interceptor;

namespace {

/// Both ends of one port in this process.
struct Channel {
    Channel() {
        shm::RingWriter out(pair.first->add_ring("port", {}));
        pair.first->publish();
        writer.bind(nullptr, std::move(out));
        reader.bind(nullptr, shm::RingReader(*pair.second->find_ring(shm::Side::first, "port")));
        open(sending, {.writer = &writer, .timed = true}, "sending");
        open(receiving, {.reader = &reader, .timed = true}, "receiving");
    }
    static void open(LinkBuffer& buffer, const LinkChannel& channel, const char* key,
                     const char* empty_policy = nullptr) {
        coil::Properties properties;
        properties.setProperty("channel", key);
        if (empty_policy) properties.setProperty("read.empty_policy", empty_policy);
        LinkBuffer::register_channel(key, channel);
        buffer.init(properties);
        LinkBuffer::unregister_channel(key);
    }
    template <class Value>
    void send(const Value& value) {
        REQUIRE(sending.writeInPlace(RTC::CdrMarshal<Value>(value)) == RTC::BufferStatus::OK);
    }
    /// Returns whether there was a message that is a value of that type.
    template <class Value>
    bool receive(Value& value) {
        RTC::CdrUnmarshal<Value> unmarshal(value);
        RTC::ByteData bytes;
        bool in_place = false;
        return receiving.readInPlace(bytes, unmarshal, in_place) == RTC::BufferStatus::OK && in_place &&
               unmarshal.valid;
    }

    Orb orb;
    shm::test::Pair pair;
    const std::function<void()> wake = [] {};
    link::ChannelWriter writer{"port", wake};
    link::ChannelReader reader{wake};
    LinkBuffer sending, receiving;
};

/// `received` has any length before.
template <class Value>
void check_crossing(Channel& channel, CORBA::ULong count, Value& received) {
    Value sent{};
    sent.tm = {count + 12, 34};
    sent.data.length(count);
    for (CORBA::ULong i = 0; i < count; ++i)
        sent.data[i] = static_cast<std::decay_t<decltype(sent.data[i])>>(7 * i + 1);
    channel.send(sent);
    REQUIRE(channel.receive(received));
    CHECK((received.tm.sec == count + 12 && received.tm.nsec == 34));
    REQUIRE(received.data.length() == count);
    for (CORBA::ULong i = 0; i < count; ++i) CHECK(received.data[i] == sent.data[i]);
}

/// Messages of that many bytes whose sequence says that it has `count` elements.
template <class Value>
void check_malformed(Channel& channel, CORBA::ULong count) {
    Value value{};
    value.data.length(count);
    const std::size_t size = sizeof value.data[0];
    const std::size_t whole = std::max(size, sizeof count) + count * size;
    for (std::size_t bytes = 0; bytes < whole; ++bytes) {
        INFO(bytes << " of " << whole << " bytes");
        REQUIRE(channel.writer.write_sized(bytes, 0, [&](std::span<std::byte> room) {
            std::fill(room.begin(), room.end(), std::byte{0});
            std::memcpy(room.data(), &count, std::min(room.size(), sizeof count));
            return true;
        }));
        CHECK_FALSE(channel.receive(value));
    }
}

} // namespace

TEST_CASE("A time and a sequence of numbers cross in place, whatever length the last one had") {
    Channel channel;
    const auto check = [&](auto received) {
        for (const CORBA::ULong count : {0U, 6U, 6U, 1U, 2U, 2U, 31U, 0U, 0U, 500U, 500U, 6U})
            check_crossing(channel, count, received);
    };
    check(RTC::TimedDoubleSeq{});
    check(RTC::TimedFloatSeq{});
    check(RTC::TimedLongSeq{});
    check(RTC::TimedUShortSeq{});
    check(RTC::TimedOctetSeq{});
}

TEST_CASE("A truncated message is not of the type, even if the value has its length") {
    Channel channel;
    check_malformed<RTC::TimedDoubleSeq>(channel, 6);
    check_malformed<RTC::TimedFloatSeq>(channel, 3);
    check_malformed<RTC::TimedOctetSeq>(channel, 5);
    RTC::TimedDoubleSeq received{};
    check_crossing(channel, 6, received);
}

TEST_CASE("An empty queue repeats the last message or returns nothing, as within a host") {
    const char* const policy = GENERATE(as<const char*>(), nullptr, "readback", "do_nothing");
    const bool in_place = GENERATE(true, false);
    const CORBA::ULong length = GENERATE(0, 3, 60'000); // the last one goes by loan
    Channel channel;
    Channel::open(channel.receiving, {.reader = &channel.reader, .timed = true}, "receiving", policy);
    RTC::CdrRingBuffer within;
    coil::Properties properties;
    if (policy) properties.setProperty("read.empty_policy", policy);
    within.init(properties);
    RTC::TimedOctetSeq sent{}, received{};
    const auto read = [&] {
        RTC::ByteData bytes;
        if (!in_place) return channel.receiving.read(bytes, {});
        RTC::CdrUnmarshal<RTC::TimedOctetSeq> unmarshal(received);
        bool read_in_place = false;
        return channel.receiving.readInPlace(bytes, unmarshal, read_in_place);
    };
    const auto expected = [&] {
        RTC::ByteData bytes;
        return within.read(bytes, std::chrono::nanoseconds(-1));
    };
    CHECK(read() == expected());
    sent.tm = {1, 2};
    sent.data.length(length);
    channel.send(sent);
    within.write({});
    for (int i = 0; i < 3; ++i) {
        const auto status = read();
        CHECK(status == expected());
        if (status != RTC::BufferStatus::OK || !in_place) continue;
        CHECK((received.tm.sec == 1 && received.data.length() == length));
    }
    CHECK(channel.reader.counters().received == 1);
}

TEST_CASE("A queue returns the newest messages that it has room for, as within a host") {
    const std::uint32_t length = GENERATE(1, 4, 8);
    Channel channel;
    channel.reader.set_depth(length);
    RTC::RingBuffer<CORBA::ULong> within(length);
    RTC::TimedULong sent{}, received{};
    for (CORBA::ULong i = 1; i < 200; ++i) {
        sent.data = i;
        channel.send(sent);
        within.write(i);
        if (i % 3 != 0) continue;
        CORBA::ULong expected = 0;
        REQUIRE(within.read(expected) == RTC::BufferStatus::OK);
        REQUIRE(channel.receive(received));
        REQUIRE(received.data == expected);
    }
    const auto counters = channel.reader.counters();
    CHECK(counters.skipped == counters.sent - counters.received - within.readable());
    CHECK(counters.waiting() == within.readable());
}

TEST_CASE(
    "A queue that refuses what it has no room for keeps the oldest messages, as within a host, and says so") {
    const std::uint32_t length = GENERATE(1, 4, 8);
    Channel channel;
    channel.writer.set_policy({.refuse = true, .length = length});
    RTC::RingBuffer<CORBA::ULong> within(length);
    coil::Properties properties;
    properties.setProperty("length", std::to_string(length));
    properties.setProperty("write.full_policy", "do_nothing");
    within.init(properties);
    RTC::TimedULong sent{}, received{};
    std::uint64_t refused = 0;
    for (CORBA::ULong i = 1; i < 200; ++i) {
        sent.data = i;
        const auto status = channel.sending.writeInPlace(RTC::CdrMarshal<RTC::TimedULong>(sent));
        REQUIRE(status == within.write(i));
        if (status == RTC::BufferStatus::FULL) ++refused;
        if (i % 3 != 0) continue;
        CORBA::ULong expected = 0;
        REQUIRE(within.read(expected) == RTC::BufferStatus::OK);
        REQUIRE(channel.receive(received));
        REQUIRE(received.data == expected);
    }
    const auto counters = channel.reader.counters();
    CHECK(counters.refused == refused);
    CHECK(counters.skipped == 0);
    CHECK(counters.waiting() == within.readable());
}
