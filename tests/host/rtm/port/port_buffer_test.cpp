// SPDX-License-Identifier: Apache-2.0
#include "host/rt/rehearsal.hpp"
#include "host/rtm/runtime/transport/buffer/port_buffer.hpp"
#include "tests/support/membarrier.hpp"
#include <atomic>
#include <catch2/catch.hpp>
#include <coil/Properties.h>
#include <random>
#include <rtm/CORBA_CdrMemoryStream.h>
#include <rtm/CdrRingBuffer.h>
#include <thread>
#include <vector>

using namespace std::chrono_literals;
using RTC::BufferStatus;

namespace {

RTC::ByteData message(unsigned char value, unsigned long length) {
    RTC::ByteData bytes;
    bytes.writeData(std::vector<unsigned char>(length, value).data(), length);
    return bytes;
}

/// Short for most values; others do not fit into a cell of the buffer's ring.
RTC::ByteData message(unsigned char value) { return message(value, value % 3 == 0 ? 100 : 20); }

int value_of(const RTC::ByteData& bytes) { return bytes.getDataLength() == 0 ? -1 : bytes.getBuffer()[0]; }

coil::Properties properties(const std::string& full_policy, const std::string& empty_policy, int length) {
    coil::Properties prop;
    prop.setProperty("length", std::to_string(length));
    prop.setProperty("write.full_policy", full_policy);
    prop.setProperty("read.empty_policy", empty_policy);
    return prop;
}

/// Runs each operation on both buffers and compares the results.
struct Both {
    explicit Both(const coil::Properties& prop) {
        ours.init(prop);
        other.init(prop);
    }
    template <class Operation>
    void check(const Operation& operation) {
        const auto [status, value] = operation(ours);
        const auto [other_status, other_value] = operation(other);
        CHECK(status == other_status);
        CHECK(value == other_value);
        CHECK(ours.readable() == other.readable());
        CHECK(ours.writable() == other.writable());
        CHECK(ours.full() == other.full());
        CHECK(ours.empty() == other.empty());
        if (++checks % 3 != 0) return; // an access by offset changes where short messages are
        for (long i = 0; i < static_cast<long>(other.readable()); ++i)
            CHECK(value_of(*ours.rptr(i)) == value_of(*other.rptr(i)));
    }
    RTC::PortBuffer ours;
    RTC::CdrRingBuffer other;
    unsigned checks = 0;
};

using Result = std::pair<BufferStatus::Enum, int>;

Result read_one(RTC::CdrBufferBase& buffer) {
    RTC::ByteData bytes;
    const BufferStatus status = buffer.read(bytes);
    return {status, value_of(bytes)};
}

Result step(RTC::CdrBufferBase& buffer, unsigned operation, unsigned char value) {
    bool overwritten = false;
    const long n = value % 5 - 2;
    switch (operation) {
    case 0:
    case 1:
        return {buffer.writeReporting(message(value), overwritten), overwritten};
    case 2:
        return {buffer.write(message(value), 0ns), 0};
    case 3:
    case 4:
        return read_one(buffer);
    case 5:
        return {buffer.advanceRptr(n), 0};
    case 6:
        // Would be put over the oldest value, or over the last one that was read.
        if (buffer.full() || buffer.length() == 1) return {BufferStatus::OK, 0};
        return {buffer.put(message(value)), value_of(*buffer.wptr())};
    case 7:
        if (buffer.full()) return {BufferStatus::OK, 0};
        buffer.put(message(value));
        return {buffer.advanceWptr(), 0};
    case 8:
        return {BufferStatus::OK, buffer.empty() ? -1 : value_of(buffer.get())};
    default:
        return {value == 0 ? buffer.reset() : BufferStatus(BufferStatus::OK),
                static_cast<int>(buffer.length())};
    }
}

/// The bytes of a value, with zeros as padding, which a stream leaves as its memory is.
std::vector<unsigned char> bytes_of(const RTC::ByteData& message, bool has_doubles) {
    std::vector<unsigned char> bytes(message.getBuffer(), message.getBuffer() + message.getDataLength());
    if (has_doubles && bytes.size() > 16) std::fill_n(bytes.begin() + 12, 4, static_cast<unsigned char>(0));
    return bytes;
}

template <class Value>
RTC::ByteData serialized(const Value& value) {
    RTC::CORBA_CdrSerializer<Value> stream;
    stream.isLittleEndian(true);
    REQUIRE(stream.serialize(value));
    RTC::ByteData message;
    message = stream;
    return message;
}

template <class Value>
void check_encoding(const Value& value) {
    constexpr bool has_doubles = std::is_same_v<Value, RTC::TimedDoubleSeq>;
    const auto expected = bytes_of(serialized(value), has_doubles);
    RTC::PortBuffer buffer;
    RTC::ByteData message;
    REQUIRE(buffer.writeInPlace(RTC::CdrMarshal<Value>(value)) == BufferStatus::OK);
    REQUIRE(buffer.read(message, -1ns) == BufferStatus::OK);
    CHECK(bytes_of(message, has_doubles) == expected);

    REQUIRE(buffer.write(message, -1ns) == BufferStatus::OK);
    Value decoded{};
    for (int reads = 0; reads < 2;
         ++reads) { // the second time the variable has the length, and readback is the policy
        RTC::CdrUnmarshal<Value> reader(decoded);
        bool in_place = false;
        REQUIRE(buffer.readInPlace(message, reader, in_place) == BufferStatus::OK);
        CHECK(in_place);
        CHECK(reader.valid);
        CHECK(bytes_of(serialized(decoded), has_doubles) == expected);
    }
}

template <class Sequence>
Sequence numbers(CORBA::ULong count) {
    Sequence value{};
    value.tm.sec = 7;
    value.tm.nsec = 8;
    value.data.length(count);
    for (CORBA::ULong i = 0; i < count; ++i)
        value.data[i] = static_cast<std::decay_t<decltype(value.data[i])>>(i + 1);
    return value;
}

} // namespace

TEST_CASE("A port's buffer does what a ring buffer with the same policies does") {
    const auto* const full_policy = GENERATE("overwrite", "do_nothing");
    const auto* const empty_policy = GENERATE("readback", "do_nothing");
    const int length = GENERATE(1, 2, 5);
    Both both(properties(full_policy, empty_policy, length));
    std::mt19937 random(static_cast<unsigned>(length));
    for (int i = 0; i < 3000; ++i) {
        const unsigned operation = random() % 10;
        const auto value = static_cast<unsigned char>(random() % 200);
        // The content before the oldest value after a reset, or before the first value, is unspecified.
        if (operation == 5 && value % 5 < 2) continue;
        INFO("operation " << operation << " with " << int{value} << " at " << i);
        both.check([&](RTC::CdrBufferBase& buffer) { return step(buffer, operation, value); });
    }
}

TEST_CASE("A port's buffer can take back what was read and what was written last") {
    Both both(properties("overwrite", "do_nothing", 4));
    for (unsigned char value = 1; value <= 3; ++value)
        both.check([&](RTC::CdrBufferBase& buffer) { return step(buffer, 0, value); });
    for (int i = 0; i < 2; ++i) both.check(read_one);
    both.check(
        [](RTC::CdrBufferBase& buffer) { return Result(buffer.advanceRptr(-2), value_of(buffer.get())); });
    both.check([](RTC::CdrBufferBase& buffer) { return Result(buffer.advanceWptr(-1), 0); });
    both.check([](RTC::CdrBufferBase& buffer) { return Result(buffer.advanceWptr(-3), 0); });
    for (int i = 0; i < 3; ++i) both.check(read_one);
}

TEST_CASE("A port's buffer can take back what was written last after it has dropped messages") {
    const long count = GENERATE(1, 2, 4);
    Both both(properties("overwrite", "do_nothing", 4));
    for (unsigned char value = 1; value <= 10; ++value)
        both.check([&](RTC::CdrBufferBase& buffer) { return step(buffer, 0, value); });
    both.check([&](RTC::CdrBufferBase& buffer) { return Result(buffer.advanceWptr(-count), 0); });
    both.check(read_one);
    for (unsigned char value = 11; value <= 13; ++value)
        both.check([&](RTC::CdrBufferBase& buffer) { return step(buffer, 0, value); });
    for (int i = 0; i < 5; ++i) both.check(read_one);
}

TEST_CASE("A new length drops the messages of a port's buffer") {
    RTC::PortBuffer buffer;
    CHECK(buffer.length() == 8);
    buffer.write(message(1), -1ns);
    CHECK(buffer.length(0) == BufferStatus::NOT_SUPPORTED);
    CHECK(buffer.length(3) == BufferStatus::OK);
    CHECK(buffer.length() == 3);
    CHECK(read_one(buffer).first == BufferStatus::EMPTY);
}

TEST_CASE("A port's buffer whose policy is block waits for the other thread") {
    RTC::PortBuffer buffer;
    buffer.init(properties("block", "block", 2));
    constexpr int last = 5000;
    std::thread writer([&] {
        for (int i = 1; i <= last; ++i)
            REQUIRE(buffer.write(message(static_cast<unsigned char>(i % 200)), -1ns) == BufferStatus::OK);
    });
    int faults = 0;
    for (int i = 1; i <= last; ++i)
        if (read_one(buffer) != Result(BufferStatus::OK, i % 200)) ++faults;
    writer.join();
    CHECK(faults == 0);
    CHECK(buffer.empty());
}

TEST_CASE("A thread that waits at a port's buffer gives up at its timeout") {
    RTC::PortBuffer buffer;
    buffer.init(properties("overwrite", "do_nothing", 1));
    RTC::ByteData bytes;
    CHECK(buffer.read(bytes, 1ms) == BufferStatus::TIMEOUT);
    CHECK(buffer.write(message(1), 1ms) == BufferStatus::OK);
    CHECK(buffer.write(message(2), 1ms) == BufferStatus::TIMEOUT); // against the policy
    CHECK(buffer.write(message(3), 0ms) == BufferStatus::OK);
    CHECK(read_one(buffer) == Result(BufferStatus::OK, 3));
    std::thread late([&] { buffer.write(message(4), -1ns); }); // does not know that a thread waits
    CHECK(buffer.read(bytes, 10s) == BufferStatus::OK);
    late.join();
    auto prop = properties("block", "block", 1);
    prop.setProperty("write.timeout", "0.001");
    prop.setProperty("read.timeout", "0.001");
    buffer.init(prop);
    CHECK(read_one(buffer).first == BufferStatus::TIMEOUT);
    CHECK(buffer.write(message(1), -1ns) == BufferStatus::OK);
    CHECK(buffer.write(message(2), -1ns) == BufferStatus::TIMEOUT);
}

TEST_CASE("Messages that are encoded in a port's buffer are those of the serializer") {
    for (const CORBA::ULong count : {0U, 1U, 2U, 6U, 2000U}) {
        check_encoding(numbers<RTC::TimedDoubleSeq>(count));
        check_encoding(numbers<RTC::TimedFloatSeq>(count));
        check_encoding(numbers<RTC::TimedShortSeq>(count));
        check_encoding(numbers<RTC::TimedOctetSeq>(count));
        check_encoding(numbers<RTC::TimedBooleanSeq>(count));
    }
    check_encoding(RTC::TimedLong{{1, 2}, 3});
    check_encoding(RTC::TimedPose2D{{1, 2}, {{3, 4}, 5}});
}

TEST_CASE(
    "A port's buffer decodes messages of the other byte order, and reports one that does not fit the type") {
    RTC::PortBuffer buffer;
    RTC::CORBA_CdrSerializer<RTC::TimedDoubleSeq> stream;
    stream.isLittleEndian(false);
    REQUIRE(stream.serialize(numbers<RTC::TimedDoubleSeq>(3)));
    RTC::ByteData bytes;
    bytes = stream;
    bytes.isLittleEndian(false);
    REQUIRE(buffer.write(bytes, -1ns) == BufferStatus::OK);
    RTC::TimedDoubleSeq value = numbers<RTC::TimedDoubleSeq>(3);
    value.data[2] = 0;
    RTC::CdrUnmarshal<RTC::TimedDoubleSeq> reader(value);
    bool in_place = false;
    REQUIRE(buffer.readInPlace(bytes, reader, in_place) == BufferStatus::OK);
    CHECK(value.tm.sec == 7);
    CHECK(value.data[2] == 3);
    REQUIRE(buffer.write(message(255), -1ns) == BufferStatus::OK);
    CHECK(buffer.readInPlace(bytes, reader, in_place) == BufferStatus::OK);
    CHECK_FALSE(reader.valid);
}

TEST_CASE("A rehearsal at a port's buffer publishes nothing, takes nothing and does not wait") {
    const bool waits = GENERATE(false, true);
    INFO("waits: " << waits);
    RTC::PortBuffer buffer;
    if (waits) buffer.init(properties("block", "block", 1));
    const auto sent = numbers<RTC::TimedDoubleSeq>(6);
    RTC::TimedDoubleSeq received{};
    RTC::CdrUnmarshal<RTC::TimedDoubleSeq> reader(received);
    RTC::ByteData bytes;
    bool in_place = false;
    for (int i = 0; i < 40; ++i) { // the thread becomes the owner of both mutexes
        REQUIRE(buffer.writeInPlace(RTC::CdrMarshal<RTC::TimedDoubleSeq>(sent)) == BufferStatus::OK);
        REQUIRE(buffer.readInPlace(bytes, reader, in_place) == BufferStatus::OK);
    }
    REQUIRE(buffer.writeInPlace(RTC::CdrMarshal<RTC::TimedDoubleSeq>(sent)) == BufferStatus::OK);
    const RTC::TimedDoubleSeq sample{};
    RTC::TimedDoubleSeq again{};
    RTC::CdrUnmarshal<RTC::TimedDoubleSeq> reader_again(again);
    {
        const tandem::rt::Rehearsal rehearsal;
        buffer.writeInPlace(RTC::CdrMarshal<RTC::TimedDoubleSeq>(sample));
        buffer.readInPlace(bytes, reader_again, in_place);
    }
    CHECK(again.data.length() == (tandem::test::mutexes_have_owners() ? 6 : 0));
    CHECK(buffer.readable() == 1);
    REQUIRE(buffer.readInPlace(bytes, reader, in_place) == BufferStatus::OK);
    CHECK(received.data.length() == 6);
    CHECK(buffer.readable() == 0);
    buffer.reset();
    {
        const tandem::rt::Rehearsal rehearsal;
        CHECK(buffer.readInPlace(bytes, reader_again, in_place) == BufferStatus::EMPTY);
    }
    CHECK(buffer.read(bytes, 0ns) == BufferStatus::EMPTY);
}
