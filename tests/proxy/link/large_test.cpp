// SPDX-License-Identifier: Apache-2.0
// Messages of megabytes across a link: by loan, both ways, and what happens to those that do not fit.
#include "link_side.hpp"
#include "tests/shm/fixture.hpp"
#include "tests/shm/small_shm.hpp"
#include "tests/support/captured_log.hpp"
#include "tests/support/skip.hpp"

#include <numeric>

using namespace tandem;
using namespace tandem::link;
using namespace tandem::link::test;
using tandem::test::CapturedLog;

namespace {

constexpr std::size_t mib = std::size_t{1} << 20;

/// An image as it travels: its number, its size, its bytes.
std::vector<std::byte> image(std::uint32_t number, std::size_t bytes) {
    std::vector<std::byte> pixels(bytes);
    for (std::size_t i = 0; i < bytes; ++i) pixels[i] = static_cast<std::byte>(number * 31 + i * 7 + i / 251);
    return pixels;
}

bool send_image(ChannelWriter& writer, std::uint32_t number, const std::vector<std::byte>& pixels) {
    return writer.write(number, [&](wire::CdrWriter& out) {
        out.put(static_cast<std::uint32_t>(pixels.size()));
        out.put_block(pixels.data(), pixels.size(), 1);
    });
}

/// The image's number if it came whole; empty if none came.
std::optional<std::uint64_t> receive_image(ChannelReader& reader) {
    std::optional<std::uint64_t> number;
    reader.read(false, [&](const shm::Record& record) {
        wire::CdrReader in(record.bytes);
        const auto pixels = in.get_block(in.get_count(1), 1);
        const auto wanted = image(static_cast<std::uint32_t>(record.stamp_ns), pixels.size());
        const bool whole = in.ok() && std::equal(pixels.begin(), pixels.end(), wanted.begin(), wanted.end());
        number = whole ? record.stamp_ns : 0;
    });
    return number;
}

struct Linked {
    explicit Linked(const std::string& what, LinkOptions first = {}, LinkOptions second = {})
        : name(unique_name(what)) {
        first.name = second.name = name;
        a = std::make_unique<LinkSide>(shm::Side::first, first, PortTable{});
        b = std::make_unique<LinkSide>(shm::Side::second, second, joystick_table());
        a->link.open();
        b->link.open();
        wait_until_up(*a, *b);
        REQUIRE(eventually([&] { return a->link.is_up() && b->link.is_up(); }));
    }
    std::string name;
    std::unique_ptr<LinkSide> a, b;
};

LinkOptions large(std::size_t bytes) {
    LinkOptions options;
    options.rings.large_bytes = bytes;
    return options;
}

void check_counters(const shm::RingCounters& c, std::uint64_t sent, std::uint64_t received) {
    CHECK(c.sent == sent);
    CHECK(c.received == received);
    CHECK(c.sent == c.received + c.dropped() + c.waiting());
}

} // namespace

TEST_CASE("an expected length spares a long message its first encoding") {
    Linked sides("expected");
    auto& writer = sides.b->link.writer("reference");
    std::size_t bytes = 0;
    int encoded = 0;
    const auto send = [&](std::size_t size) {
        const auto pixels = image(7, size);
        return writer.write_expecting(bytes, 7, [&](wire::CdrWriter& out) {
            ++encoded;
            if (size == 13) throw std::runtime_error("no message");
            out.put(static_cast<std::uint32_t>(size));
            out.put_block(pixels.data(), size, 1);
        });
    };
    const auto encodings = [&](std::size_t size) {
        encoded = 0;
        REQUIRE(send(size));
        CHECK(bytes == size + 4);
        CHECK(receive_image(sides.a->link.reader("reference")) == 7);
        return encoded;
    };
    CHECK(encodings(100) == 1);
    CHECK(encodings(100) == 1);
    CHECK(encodings(mib) == 2); // its length is new
    CHECK(encodings(mib) == 1);
    CHECK_THROWS(send(13)); // and gives the memory back that was meant for it
    CHECK(encodings(mib) == 1);
    CHECK(encodings(2 * mib) == 3);
    CHECK(encodings(100) == 2);
}

TEST_CASE("images of 1 MiB and 1080p pass in both directions by default") {
    Linked link("image");
    std::uint32_t number = 0;
    for (const std::size_t bytes : {mib, 6 * mib, 1920 * 1080 * std::size_t{4}}) {
        for (int i = 0; i < 3; ++i) {
            const auto pixels = image(++number, bytes);
            REQUIRE(send_image(link.b->link.writer("reference"), number, pixels));
            REQUIRE(send_image(link.a->link.writer("position"), number, pixels));
            CHECK(receive_image(link.a->link.reader("reference")) == number);
            CHECK(receive_image(link.b->link.reader("position")) == number);
        }
    }
    check_counters(link.a->link.reader("reference").counters(), number, number);
    check_counters(link.b->link.reader("position").counters(), number, number);
}

TEST_CASE("64 MiB pass in both directions, whichever side requests them") {
    const bool adaptor_asks = GENERATE(true, false);
    Linked link("huge", adaptor_asks ? large(65 * mib) : LinkOptions{},
                adaptor_asks ? large(2 * mib) : large(65 * mib));
    const auto pixels = image(9, 64 * mib);
    REQUIRE(send_image(link.b->link.writer("reference"), 9, pixels));
    CHECK(receive_image(link.a->link.reader("reference")) == 9);
    REQUIRE(send_image(link.a->link.writer("position"), 9, pixels));
    CHECK(receive_image(link.b->link.reader("position")) == 9);
}

TEST_CASE("a side whose large_kib is below the default does not shorten the other side's messages") {
    const bool adaptor_asks = GENERATE(true, false);
    Linked link("less", large(adaptor_asks ? mib : 0), large(adaptor_asks ? 0 : mib));
    const auto pixels = image(9, 6 * mib);
    REQUIRE(send_image(link.b->link.writer("reference"), 9, pixels));
    CHECK(receive_image(link.a->link.reader("reference")) == 9);
    REQUIRE(send_image(link.a->link.writer("position"), 9, pixels));
    CHECK(receive_image(link.b->link.reader("position")) == 9);
}

TEST_CASE("a long message is written where the peer reads it") {
    Linked link("place");
    std::span<std::byte> room;
    auto& writer = link.b->link.writer("reference");
    REQUIRE(writer.write_sized(mib, 5, [&](std::span<std::byte> bytes) {
        room = bytes;
        std::fill(room.begin(), room.end(), std::byte{'a'});
        return true;
    }));
    link.a->link.reader("reference").read(false, [&](const shm::Record& record) {
        CHECK(record.stamp_ns == 5);
        REQUIRE(record.bytes.size() == mib);
        CHECK(record.bytes[77] == std::byte{'a'});
        room[77] = std::byte{'b'}; // this test has both ends: the same page of the same file
        CHECK(record.bytes[77] == std::byte{'b'});
    });
}

TEST_CASE("an image sequence that outruns its reader arrives in order, and the counts add up") {
    Linked link("sequence");
    auto& writer = link.b->link.writer("reference");
    auto& reader = link.a->link.reader("reference");
    constexpr std::uint32_t count = 60;
    std::vector<std::vector<std::byte>> images;
    for (std::uint32_t i = 1; i <= count; ++i) images.push_back(image(i, mib + i * 1000));
    std::atomic<bool> done{false};
    std::thread sender([&] {
        for (std::uint32_t i = 1; i <= count; ++i) send_image(writer, i, images[i - 1]);
        done = true;
    });
    std::uint64_t received = 0, last = 0;
    bool in_order = true;
    while (last != count) {
        const auto number = receive_image(reader);
        if (!number && done && reader.empty()) break;
        if (!number) continue;
        in_order = in_order && *number > last; // 0: not whole
        last = *number;
        ++received;
    }
    sender.join();
    CHECK(in_order);
    CHECK(last == count);
    const auto c = reader.counters();
    CHECK(c.sent == count);
    CHECK(c.received == received);
    CHECK(c.sent == c.received + c.dropped());
}

TEST_CASE("a message that is too long is refused, counted and logged once, and later ones pass") {
    const CapturedLog log;
    Linked link("long", large(mib), large(mib));
    auto& writer = link.b->link.writer("reference");
    auto& reader = link.a->link.reader("reference");
    const auto too_long = image(1, mib);
    for (int i = 0; i < 3; ++i) CHECK_FALSE(send_image(writer, 1, too_long));
    CHECK(log.lines_with(
              "port 'reference': a message of 1048580 bytes is longer than 1048576 and is dropped") == 1);
    CHECK(log.lines_with("raise large_kib to 1025 or more") == 1);
    REQUIRE(send(writer, 2.5));
    CHECK(receive(reader) == 2.5);
    REQUIRE(send_image(writer, 2, image(2, mib / 2)));
    CHECK(receive_image(reader) == 2);
    check_counters(reader.counters(), 5, 2);
    CHECK(reader.counters().refused == 3);
}

TEST_CASE("small messages stay in the ring however long the last one was") {
    Linked link("small");
    auto& writer = link.b->link.writer("reference");
    auto& reader = link.a->link.reader("reference");
    REQUIRE(send_image(writer, 1, image(1, 2 * mib)));
    REQUIRE(receive_image(reader) == 1);
    // More than there are chunks: in chunks, only the last of them would be left.
    for (int i = 0; i < 100; ++i) REQUIRE(send(writer, i));
    for (int i = 0; i < 100; ++i) CHECK(receive(reader) == i);
    CHECK(reader.counters().dropped() == 0);
}

TEST_CASE("a side that returns finds free chunks even if the other side held one and others waited") {
    Linked link("restart", large(2 * mib));
    std::uint32_t number = 0;
    for (int round = 0; round < 3; ++round) {
        const bool reader_leaves = round == 1;
        for (int i = 0; i < 3; ++i) {
            ++number;
            REQUIRE(send_image(link.b->link.writer("reference"), number, image(number, mib)));
            REQUIRE(send_image(link.a->link.writer("position"), number, image(number, mib)));
        }
        CHECK(receive_image(link.a->link.reader("reference")) == number - 2); // held until the next read
        CHECK(receive_image(link.b->link.reader("position")) == number - 2);
        LinkOptions options = large(2 * mib);
        options.name = link.name;
        if (reader_leaves) {
            link.a.reset();
            link.a = std::make_unique<LinkSide>(shm::Side::first, options, PortTable{});
            link.a->link.open();
        } else {
            link.b.reset();
            link.b = std::make_unique<LinkSide>(shm::Side::second, options, joystick_table());
            link.b->link.open();
        }
        // The remaining side notices a moment later that its session is over.
        REQUIRE(eventually([&] {
            return link.a->link.is_up() && link.b->link.is_up() &&
                   send(link.b->link.writer("reference"), number) &&
                   receive(link.a->link.reader("reference")) == number;
        }));
    }
    CHECK(segments_of(link.name) == 1);
    link.a.reset();
    link.b.reset();
    CHECK(segments_of(link.name) == 0);
}

TEST_CASE("ports whose type sets a bound below the ring's get no chunks") {
    const PortTable table{{{"X"}},
                          {{PortKind::data_out, "number", "T", "(uu)d", "", {}},
                           {PortKind::data_out, "image", "T", "(uu)qqqsday", "", {}},
                           {PortKind::service_provided, "service", "T", "", "s", {}},
                           {PortKind::data_in, "matrix", "T", "[100000]d", "", {}}}};
    const auto plan = plan_rings(table, shm::Side::second, {});
    REQUIRE(plan.rings.size() == 3);
    CHECK(plan.rings[0].options.chunks == 0);
    CHECK(plan.rings[1].options.chunks == 4);
    CHECK(plan.rings[1].options.chunk_bytes == default_large_bytes);
    CHECK(plan.rings[1].options.writer == shm::Side::second);
    CHECK(plan.rings[2].options.chunks == 4);
    CHECK(plan.rings[2].options.writer == shm::Side::first);
    CHECK(plan.chunk_bytes >= 8 * default_large_bytes);
    CHECK(plan_rings(table, shm::Side::second, {.large_bytes = 1000}).chunk_bytes == 0);
}

namespace {

/// Runs in a /dev/shm of 12 MiB, which has room for one image of 8 MiB but not for a second one.
int images_in_small_shm() {
    if (!shm::test::enter_small_shm(12)) return shm::test::not_permitted;
    const CapturedLog log;
    Linked link("narrow");
    auto& writer = link.b->link.writer("reference");
    auto& reader = link.a->link.reader("reference");
    const auto pixels = image(3, default_large_bytes - 100);
    if (!send_image(writer, 3, pixels) || receive_image(reader) != 3) return 1;
    for (int i = 0; i < 3; ++i) // the reader holds the first one until its next read
        if (send_image(writer, 3, pixels)) return 2;
    if (log.lines_with(
            "port 'reference': a message of 8388512 bytes does not fit into the free memory of /dev/shm") !=
        2)
        return 3;
    if (!send(writer, 4.5) || receive(reader) != 4.5) return 4;
    if (!send_image(writer, 3, pixels) || receive_image(reader) != 3) return 5;
    const auto c = reader.counters();
    return c.sent == 6 && c.received == 3 && c.refused == 3 ? 0 : 6;
}

/// A /dev/shm of 24 MiB has no room for a large_kib of 8 MiB, which needs four chunks.
int asks_for_too_much() {
    if (!shm::test::enter_small_shm(24)) return shm::test::not_permitted;
    LinkOptions options = large(8 * mib);
    options.name = unique_name("much");
    LinkSide side(shm::Side::second, options, joystick_table());
    try {
        side.link.open();
        return 1;
    } catch (const shm::Error& error) {
        const std::string text = error.what();
        // A page or so of the 24 MiB may be the file system's own.
        const bool good =
            text.find("33554432 bytes needed for 4 messages of large_kib = 8192, 251") != std::string::npos &&
            text.find(" available; enlarge it, free some, or lower large_kib") != std::string::npos;
        if (!good) fprintf(stderr, "%s\n", text.c_str());
        return good && segments_of(options.name) == 0 ? 0 : 2;
    }
}

} // namespace

TEST_CASE("an image without memory in /dev/shm is dropped and reported, and others pass") {
    shm::test::Child child(images_in_small_shm);
    const int result = child.wait();
    if (result == shm::test::not_permitted)
        TANDEM_SKIP_PART("this process may not mount a file system");
    else
        CHECK(result == 0);
}

TEST_CASE("a large_kib beyond the room in /dev/shm is an error with both numbers when the link is opened") {
    shm::test::Child child(asks_for_too_much);
    const int result = child.wait();
    if (result == shm::test::not_permitted)
        TANDEM_SKIP_PART("this process may not mount a file system");
    else
        CHECK(result == 0);
}
