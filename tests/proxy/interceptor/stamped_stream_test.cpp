// SPDX-License-Identifier: Apache-2.0
// CORBA streams over a message whose time lies apart, against the ORB's own.
#include "proxy/interceptor/corba/stamped_stream.hpp"
#include "proxy/wire/time.hpp"
#include "tests/proxy/interceptor/orb.hpp"

#include "Chair.hh"

#include <catch2/catch.hpp>

#include <cstring>
#include <vector>

using namespace tandem;
using interceptor::StampedInStream;
using interceptor::StampedOutStream;

namespace {

/// Time, then everything that needs alignment: octets, strings, structures, doubles.
struct Message {
    CORBA::ULong sec = 0, nsec = 0;
    CORBA::Octet octet = 0;
    TestChair::Seats seats;
    TestChair::Doubles doubles;

    void operator>>=(cdrStream& out) const {
        sec >>= out;
        nsec >>= out;
        out.marshalOctet(octet);
        seats >>= out;
        doubles >>= out;
    }
    void operator<<=(cdrStream& in) {
        sec <<= in;
        nsec <<= in;
        octet = in.unmarshalOctet();
        seats <<= in;
        doubles <<= in;
    }
};

Message example() {
    Message message;
    message.sec = 1700000000;
    message.nsec = 5;
    message.octet = 7;
    message.seats.length(2);
    message.seats[0].name = CORBA::string_dup("left");
    for (auto* seat : {&message.seats[0], &message.seats[1]}) {
        seat->legs = 3;
        for (auto& height : seat->height) height = 0.5;
        seat->used = true;
    }
    message.seats[1].name = CORBA::string_dup("a longer name, of odd length");
    message.doubles.length(100);
    for (CORBA::ULong i = 0; i < 100; ++i) message.doubles[i] = i / 3.0;
    return message;
}

std::vector<std::byte> bytes_by_orb(const Message& message) {
    cdrMemoryStream stream(0, true); // padding is zero
    message >>= stream;
    std::vector<std::byte> bytes(stream.bufSize());
    std::memcpy(bytes.data(), stream.bufPtr(), bytes.size());
    return bytes;
}

constexpr std::size_t head = 8;

} // namespace

TEST_CASE("the written bytes are those of the ORB, with or without a separate time") {
    const interceptor::Orb orb;
    const auto message = example();
    const auto wanted = bytes_by_orb(message);
    const bool timed = GENERATE(true, false);
    std::vector<std::byte> body(wanted.size() - (timed ? head : 0));
    StampedOutStream out(body, timed);
    CHECK_FALSE(out.is_complete());
    message >>= out;
    CHECK(out.is_complete());
    CHECK(std::equal(body.begin(), body.end(), wanted.end() - static_cast<std::ptrdiff_t>(body.size())));
    if (timed) CHECK(out.packed_time() == wire::pack_time(1700000000, 5));
}

TEST_CASE("written messages are read back, with or without a separate time") {
    const interceptor::Orb orb;
    const auto bytes = bytes_by_orb(example());
    const bool timed = GENERATE(true, false);
    const std::span<const std::byte> all(bytes);
    StampedInStream in(all.subspan(timed ? head : 0), timed, wire::pack_time(1700000000, 5));
    Message message;
    message <<= in;
    CHECK((bytes_by_orb(message) == bytes));
}

TEST_CASE("with the time before the message the bytes are contiguous and those of the ORB") {
    const interceptor::Orb orb;
    const auto wanted = bytes_by_orb(example());
    std::vector<std::byte> whole(wanted.size() + 100);
    const auto body = std::span(whole).subspan(head);
    StampedOutStream out;
    StampedInStream in;
    for (int round = 0; round < 2; ++round) { // a stream is used for one message after the other
        out.open(body, true, whole.data());
        example() >>= out;
        CHECK(out.body_bytes() == wanted.size() - head);
        CHECK(out.packed_time() == wire::pack_time(1700000000, 5));
        CHECK(std::equal(wanted.begin(), wanted.end(), whole.begin()));
        std::fill_n(whole.begin(), head, std::byte{0xee});
        in.open(body.first(out.body_bytes()), true, wire::pack_time(1700000000, 5), whole.data());
        Message message;
        message <<= in;
        CHECK((bytes_by_orb(message) == wanted));
        in.open(body.first(out.body_bytes() - 1), true, 0, whole.data());
        CHECK_THROWS_AS(message <<= in, CORBA::MARSHAL);
    }
}

TEST_CASE("a message that ends early throws, wherever it ends, and nothing beyond it is accessed") {
    const interceptor::Orb orb;
    const auto whole = bytes_by_orb(example());
    for (std::size_t length = 0; length < whole.size() - head; ++length) {
        // A buffer of exactly that size, so that a sanitizer notices one byte too many.
        const std::vector<std::byte> cut(whole.begin() + head,
                                         whole.begin() + static_cast<long>(head + length));
        StampedInStream in(cut, true, 0);
        Message message;
        CHECK_THROWS_AS(message <<= in, CORBA::MARSHAL);
        std::vector<std::byte> small(length);
        StampedOutStream out(small, true);
        CHECK_THROWS_AS(example() >>= out, CORBA::MARSHAL);
    }
}

TEST_CASE("a count that the message cannot hold is refused before anything is allocated") {
    const interceptor::Orb orb;
    for (const std::uint32_t count : {0x7fffffffU, 0xffffffffU, 17U}) {
        std::vector<std::byte> body(16 + 8 * 16);
        std::memcpy(body.data() + 8, &count, sizeof count); // octet, padding, no seats, count of doubles
        StampedInStream in(body, true, 0);
        Message message;
        CHECK_THROWS_AS(message <<= in, CORBA::MARSHAL);
        CHECK(message.doubles.length() == 0);
    }
}
