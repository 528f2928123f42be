// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/time.hpp"
#include "tests/support/check_copies.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <random>

using namespace tandem::wire;

namespace {
using Bytes = std::span<const std::byte>;
std::array<std::byte, 64> buffer;
Bytes written(const CdrWriter& writer) { return Bytes(buffer).first(writer.size()); }
} // namespace

TEST_CASE("primitives lie at multiples of their size from the start of the payload") {
    buffer.fill(std::byte{0xee});
    CdrWriter writer(buffer);
    writer.put<std::uint8_t>(1);
    writer.put<std::uint32_t>(0x04030201);
    writer.put<std::int16_t>(-2);
    writer.put<double>(1.0);
    REQUIRE(writer.size() == 24);
    const unsigned char expected[] = {1, 0, 0, 0, 1, 2, 3, 4, 0xfe, 0xff, 0,    0,
                                      0, 0, 0, 0, 0, 0, 0, 0, 0,    0,    0xf0, 0x3f};
    CHECK(std::memcmp(buffer.data(), expected, sizeof expected) == 0);
}

TEST_CASE("written values are read back") {
    CdrWriter writer(buffer);
    writer.put_bool(true);
    writer.put_string("motor");
    writer.put<std::int64_t>(-5);
    writer.put_string("");
    REQUIRE(writer.fits());
    CdrReader reader(written(writer));
    CHECK(reader.get_bool());
    CHECK(reader.get_string() == "motor");
    CHECK(reader.get<std::int64_t>() == -5);
    CHECK(reader.get_string().empty());
    CHECK(reader.ok());
    CHECK(reader.remaining() == 0);
}

TEST_CASE("a writer without room counts the bytes that the message needs and does not write beyond the end") {
    buffer.fill(std::byte{0xee});
    CdrWriter writer(std::span<std::byte>(buffer).first(4));
    writer.put<std::uint32_t>(1);
    writer.put<double>(2.0);
    CHECK_FALSE(writer.fits());
    CHECK(writer.size() == 16);
    CHECK(buffer[4] == std::byte{0xee});
}

TEST_CASE("a span that just fits, a growing buffer and a vector get the same bytes") {
    const auto put_message = [](CdrWriter& out, std::size_t doubles) {
        const std::vector<double> values(doubles, 1.5);
        out.put<std::uint8_t>(7);
        out.put_string("axis");
        out.put(static_cast<std::uint32_t>(doubles));
        out.put_block(values.data(), 8 * values.size(), 8);
        out.put<std::int16_t>(-1);
    };
    const std::size_t doubles = GENERATE(0U, 1U, 6U, 16U, 17U, 1000U);
    CdrWriter measure(std::span<std::byte>{});
    put_message(measure, doubles);
    std::vector<std::byte> exact(measure.size(), std::byte{0xee}), vector;
    CdrWriter to_span{std::span<std::byte>(exact)}, to_vector(vector);
    put_message(to_span, doubles);
    put_message(to_vector, doubles);
    MessageBuffer memory; // its memory held another message before
    std::fill(memory.memory().begin(), memory.memory().end(), std::byte{0xee});
    CdrWriter to_buffer(memory);
    put_message(to_buffer, doubles);
    REQUIRE((to_span.fits() && to_vector.fits() && to_buffer.fits()));
    CHECK(vector == exact);
    CHECK(std::equal(exact.begin(), exact.end(), to_buffer.written().begin(), to_buffer.written().end()));
}

TEST_CASE("spare memory is lent to one user at a time") {
    std::vector<std::byte> first(100);
    const auto* const memory = first.data();
    give_back(std::move(first));
    auto taken = take_spare_bytes();
    CHECK(taken.data() == memory);
    const MessageBuffer one, other;
    CHECK(const_cast<MessageBuffer&>(one).memory().data() !=
          const_cast<MessageBuffer&>(other).memory().data());
    CHECK(const_cast<MessageBuffer&>(one).memory().data() != memory);
    give_back(std::vector<std::byte>(1 << 20)); // too large to be kept
    CHECK(take_spare_bytes().capacity() < (1 << 20));
}

TEST_CASE("a message that ends early reads as zero, and is not ok") {
    CdrWriter writer(buffer);
    writer.put<std::uint32_t>(7);
    CdrReader reader(written(writer).first(3));
    CHECK(reader.get<std::uint32_t>() == 0);
    CHECK_FALSE(reader.ok());
    CHECK(reader.get<std::uint8_t>() == 0);
}

TEST_CASE("a string without NUL, a wrong boolean and a count past the end are refused") {
    const std::array<unsigned char, 8> no_nul{4, 0, 0, 0, 'a', 'b', 'c', 'd'};
    CdrReader text(std::as_bytes(std::span(no_nul)));
    CHECK(text.get_string().empty());
    CHECK_FALSE(text.ok());
    const std::array<unsigned char, 1> two{2};
    CdrReader boolean(std::as_bytes(std::span(two)));
    boolean.get_bool();
    CHECK_FALSE(boolean.ok());
    const std::array<unsigned char, 8> count{0xff, 0xff, 0xff, 0x7f};
    CdrReader sequence(std::as_bytes(std::span(count)));
    CHECK(sequence.get_count(8) == 0);
    CHECK_FALSE(sequence.ok());
}

TEST_CASE("random bytes never crash a reader") {
    std::mt19937 random(1);
    for (int round = 0; round < 20'000; ++round) {
        for (auto& byte : buffer) byte = static_cast<std::byte>(random());
        CdrReader reader(Bytes(buffer).first(random() % buffer.size()));
        for (int step = 0; step < 20 && reader.ok(); ++step) {
            switch (random() % 5) {
            case 0:
                reader.get<double>();
                break;
            case 1:
                reader.get_string();
                break;
            case 2:
                reader.get_bool();
                break;
            case 3:
                reader.get_block(reader.get_count(4) * 4, 4);
                break;
            default:
                reader.get<std::uint16_t>();
                break;
            }
        }
        REQUIRE(reader.position() <= buffer.size());
    }
}

TEST_CASE("a time passes through the header bit for bit") {
    const auto stamp = pack_time(4'000'000'000u, 4'123'456'789u);
    CHECK(stamp_seconds(stamp) == 4'000'000'000u);
    CHECK(stamp_nanoseconds(stamp) == 4'123'456'789u);
}

TEST_CASE("blocks of all lengths are copied completely, and nothing around them") {
    for (std::size_t length = 0; length <= 200; ++length) {
        std::vector<std::byte> from(length), to(length + 2, std::byte{0xee});
        for (std::size_t i = 0; i < length; ++i) from[i] = static_cast<std::byte>(i + 1);
        copy_block(to.data() + 1, from.data(), length);
        INFO(length);
        CHECK(std::equal(from.begin(), from.end(), to.begin() + 1));
        CHECK((to.front() == std::byte{0xee} && to.back() == std::byte{0xee}));
    }
}

TEST_CASE("a sequence is its count and its elements, wherever it begins and however much room there is") {
    const auto check = [](auto number, std::size_t count, std::size_t bytes_before) {
        using Number = decltype(number);
        std::vector<Number> values(count);
        for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<Number>(3 * i + 1);
        const auto put_before = [&](CdrWriter& out) {
            for (std::size_t i = 0; i < bytes_before; ++i) out.put<std::uint8_t>(9);
        };
        std::vector<std::byte> expected;
        CdrWriter by_element(expected);
        put_before(by_element);
        by_element.put(static_cast<std::uint32_t>(count));
        for (const Number value : values) by_element.put(value);
        for (const std::size_t spare : {0, 1, 7, 8, 40}) {
            std::vector<std::byte> room(expected.size() + spare, std::byte{0xee});
            CdrWriter out{std::span<std::byte>(room)};
            put_before(out);
            out.put_sequence(values.data(), count);
            INFO(sizeof(Number) << " bytes, count " << count << ", behind " << bytes_before << ", spare "
                                << spare);
            REQUIRE(out.size() == expected.size());
            CHECK(std::equal(expected.begin(), expected.end(), room.begin()));
            CdrReader in(out.written());
            for (std::size_t i = 0; i < bytes_before; ++i) in.get<std::uint8_t>();
            const auto block = in.get_sequence(sizeof(Number), cdr_alignment<Number>);
            CHECK((in.ok() && in.remaining() == 0));
            REQUIRE(block.size() == count * sizeof(Number));
            CHECK((count == 0 || std::memcmp(block.data(), values.data(), block.size()) == 0));
        }
    };
    for (const std::size_t count : {0, 1, 2, 6, 40})
        for (std::size_t before = 0; before < 9; ++before) {
            check(double{}, count, before);
            check(std::int16_t{}, count, before);
            check(std::uint8_t{}, count, before);
        }
}

TEST_CASE("a sequence that the message does not hold is not read") {
    for (const std::uint32_t count : {2U, 0xffffffffU}) {
        CdrWriter out(buffer);
        out.put(count);
        out.put(1.5);
        CdrReader in(written(out));
        CHECK(in.get_sequence(sizeof(double), 8).empty());
        CHECK_FALSE(in.ok());
    }
    CdrReader empty(Bytes{});
    CHECK(empty.get_sequence(1, 1).empty());
    CHECK_FALSE(empty.ok());
}

TEST_CASE("long blocks are copied whatever the distance of the addresses") {
    tandem::test::check_copies(copy_long);
}
