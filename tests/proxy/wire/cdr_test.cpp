// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/time.hpp"

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

TEST_CASE("what is written is read back") {
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

TEST_CASE("a writer without room counts what the message needs and leaves the rest alone") {
    buffer.fill(std::byte{0xee});
    CdrWriter writer(std::span<std::byte>(buffer).first(4));
    writer.put<std::uint32_t>(1);
    writer.put<double>(2.0);
    CHECK_FALSE(writer.fits());
    CHECK(writer.size() == 16);
    CHECK(buffer[4] == std::byte{0xee});
}

TEST_CASE("a message that ends early reads as zero and not ok") {
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

TEST_CASE("a time goes through the header bit for bit") {
    const auto stamp = pack_time(4'000'000'000u, 4'123'456'789u);
    CHECK(stamp_seconds(stamp) == 4'000'000'000u);
    CHECK(stamp_nanoseconds(stamp) == 4'123'456'789u);
}
