// SPDX-License-Identifier: Apache-2.0
// The messages of ports as the page plots them: all of them, not only the newest of each state.
#include "tests/apps/tandem/monitor/http_client.hpp"

#include "apps/tandem/monitor/samples/message_numbers.hpp"
#include "apps/tandem/monitor/samples/picture.hpp"
#include "apps/tandem/monitor/samples/sample_feed.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/time.hpp"
#include "shm/ring/ring_reader.hpp"
#include "shm/ring/ring_writer.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace tandem::monitor::test;
using namespace tandem::shm;
using namespace tandem::shm::test;
using Json = nlohmann::json;

namespace {

std::span<const std::byte> bytes_of_number(const double& value) {
    return std::as_bytes(std::span(&value, 1));
}

Json follow(const std::string& link, const std::vector<std::string>& ports) {
    Json list = Json::array();
    for (const auto& port : ports) list.push_back({{"link", link}, {"owner", "first"}, {"port", port}});
    return {{"follow", list}};
}

/// A client of a link's port `speed`, whose first sample has come.
struct Plotter : Live {
    Plotter(const RunningMonitor& monitor, const std::string& link, RingWriter& writer)
        : Live(monitor, 0, "/api/samples") {
        send(follow(link, {"speed"}).dump());
        REQUIRE(eventually([&] {
            writer.write(bytes_of_number(-1), now_ns());
            send(R"({"follow": 0})"); // its answer shows that the follower had time
            for (auto message = next();; message = next())
                if (message.contains("ports"))
                    return true;
                else if (message.contains("error"))
                    return false;
        }));
    }
    /// Returns the next samples until there are so many with a value of at least 0.
    std::vector<Json> collect(std::size_t count) {
        std::vector<Json> samples;
        while (samples.size() < count)
            if (const auto message = next(); message.contains("ports"))
                for (const auto& port : message["ports"])
                    for (const auto& sample : port["samples"])
                        if (sample[2].is_null() || sample[2] >= 0) samples.push_back(sample);
        return samples;
    }
};

} // namespace

TEST_CASE("the numbers of a message have the names of their members") {
    const auto message = nlohmann::ordered_json::parse(
        R"({"tm":{"sec":1,"nsec":2},"data":[1.5,true],"text":"4","lost":"nan","list":[{"x":3}]})");
    const auto numbers = tandem::monitor::numbers_of(message);
    CHECK(numbers.names ==
          std::vector<std::string>{"tm.sec", "tm.nsec", "data[0]", "data[1]", "lost", "list[0].x"});
    CHECK(numbers.values[3] == 1);
    CHECK(std::isnan(numbers.values[4]));
    CHECK(tandem::monitor::numbers_of(5).names == std::vector<std::string>{"value"});
    const nlohmann::ordered_json long_list = std::vector<int>(1000, 1);
    CHECK(tandem::monitor::numbers_of(long_list).names.size() ==
          tandem::monitor::MessageNumbers::max_numbers);
}

TEST_CASE("the times of messages are the sender's, whatever its clock shows") {
    using tandem::wire::pack_time;
    const double wall_ms = static_cast<double>(tandem::command::wall_clock_ns()) / 1e6;
    const auto seconds = [](std::uint64_t ns) { return static_cast<std::uint32_t>(ns / 1'000'000'000); };
    for (const std::uint32_t start : {seconds(tandem::command::wall_clock_ns()), seconds(now_ns()), 7U}) {
        tandem::monitor::SampleClock clock;
        const double first = clock.time_of(pack_time(start, 0));
        CHECK(std::abs(first - wall_ms) < 4000);
        for (int i = 1; i < 50; ++i)
            CHECK(clock.time_of(pack_time(start, i * 10'000'000)) == Approx(first + 10.0 * i).margin(0.5));
    }
    tandem::monitor::SampleClock clock; // without stamps
    const double first = clock.time_of(0);
    CHECK(std::abs(first - wall_ms) < 4000);
    CHECK(clock.time_of(0) > first);
}

TEST_CASE("the times of messages continue when the clock of the machine is set") {
    using tandem::monitor::ClockTimes;
    using tandem::wire::pack_time;
    for (const double set_ms : {-3'600'000.0, -1000.0, 3'600'000.0}) {
        INFO(set_ms);
        tandem::monitor::SampleClock clock(ClockTimes{5e6, 1000});
        double wall_ms = 5e6, monotonic_ms = 1000;
        const auto sent_now = [&] {
            wall_ms += 10;
            monotonic_ms += 10;
            const auto sec = static_cast<std::uint32_t>(wall_ms / 1000);
            const auto nsec = static_cast<std::uint32_t>((wall_ms - 1000.0 * sec) * 1e6);
            return clock.time_of(pack_time(sec, nsec), ClockTimes{wall_ms, monotonic_ms});
        };
        CHECK(sent_now() == Approx(5e6 + 10));
        wall_ms += set_ms;
        for (int i = 2; i < 50; ++i) CHECK(sent_now() == Approx(5e6 + set_ms + 10 * i).margin(0.01));
    }
}

TEST_CASE("pictures are recognized by their members, and read from their bytes") {
    using tandem::wire::parse_signature;
    const auto raw = parse_signature("{raw}s{width}i{height}i{pixelByte}i{size}t{data}ay");
    CHECK(tandem::monitor::is_picture(raw));
    CHECK(tandem::monitor::is_picture(
        parse_signature("{data}({image}({width}u{height}u{format}e{raw_data}ay)){error_code}u")));
    CHECK_FALSE(tandem::monitor::is_picture(parse_signature("{width}i{height}i{rows}aay")));
    CHECK_FALSE(tandem::monitor::is_picture(parse_signature("{data}ay")));
    std::vector<std::byte> bytes;
    tandem::wire::CdrWriter out(bytes);
    out.put_string("raw");
    for (const std::int32_t number : {2, 1, 3}) out.put(number);
    out.put(std::uint64_t{6});
    out.put(std::uint32_t{6});
    for (const std::uint8_t byte : {1, 2, 3, 4, 5, 6}) out.put(byte);
    const auto picture = tandem::monitor::picture_in(raw, bytes);
    REQUIRE(picture);
    CHECK(picture->width == 2);
    CHECK(picture->height == 1);
    CHECK(picture->pixels.size() == 6);
    bytes.pop_back();
    CHECK_FALSE(tandem::monitor::picture_in(raw, bytes));
}

TEST_CASE("a long name of a picture's format is cut") {
    const auto type = tandem::wire::parse_signature("{format}s{width}i{height}i{data}ay");
    std::vector<std::byte> bytes;
    tandem::wire::CdrWriter out(bytes);
    out.put_string(std::string(100'000, 'x'));
    for (const std::uint32_t number : {1, 1, 0}) out.put(number); // the last one: no pixels
    const auto picture = tandem::monitor::picture_in(type, bytes);
    REQUIRE(picture);
    CHECK(picture->format == std::string(64, 'x'));
}

TEST_CASE("a plot gets every message, with its number and a time that never decreases") {
    const Pair pair;
    const auto rings = add_ports(*pair.first, {"speed", "level"});
    RingWriter writer(rings[0]), other(rings[1]);
    const RunningMonitor monitor(pair.link.name);
    Plotter page(monitor, pair.link.name, writer);
    constexpr int count = 20;
    for (int i = 0; i < count; ++i) {
        const double value = i == 7 ? std::nan("") : i;
        writer.write(bytes_of_number(value), now_ns());
        other.write(bytes_of_number(100), now_ns());
    }
    const auto samples = page.collect(count);
    REQUIRE(samples.size() == count);
    for (int i = 0; i < count; ++i) {
        if (i == 7)
            CHECK(samples[7][2].is_null());
        else
            CHECK(samples[i][2] == i);
        if (i > 0) CHECK(samples[i][0] == samples[i - 1][0].get<std::uint64_t>() + 1);
        if (i > 0) CHECK(samples[i][1] >= samples[i - 1][1]); // in steps of a microsecond
    }
}

TEST_CASE("messages that are overwritten before a plot gets them are missing in its numbers") {
    const Pair pair;
    const auto rings = add_ports(*pair.first, {"speed"});
    RingWriter writer(rings[0]);
    RingReader reader(*pair.second->find_ring(Side::first, tandem::link::ring_name("speed")));
    const RunningMonitor monitor(pair.link.name);
    Plotter page(monitor, pair.link.name, writer);
    const auto send_all = [&](int count) {
        for (int i = 0; i < count; ++i) {
            while (reader.read()) {
            }
            writer.write(bytes_of_number(0), now_ns());
        }
    };
    std::uint64_t missing = 0, last = 0;
    REQUIRE(eventually([&] {
        send_all(20'000);
        for (const auto& sample : page.collect(1)) {
            const std::uint64_t number = sample[0];
            if (last != 0 && number > last + 1) missing += number - last - 1;
            last = number;
        }
        return missing > 0;
    }));
}

TEST_CASE("hostile requests for samples are refused, and the next one is answered") {
    const Pair pair;
    const auto rings = add_ports(*pair.first, {"speed"});
    RingWriter writer(rings[0]);
    RunningMonitor monitor(pair.link.name);
    Live page(monitor, 0, "/api/samples");
    const std::string many = follow(pair.link.name, std::vector<std::string>(17, "speed")).dump();
    for (const std::string& request :
         {std::string("nonsense"), std::string("[]"), std::string(R"({"follow":5})"),
          std::string(R"({"follow":[5]})"),
          std::string(R"({"follow":[{"link":"../x","owner":"first","port":"p"}]})"),
          std::string(R"({"follow":[{"link":7,"owner":"first","port":"p"}]})"), many}) {
        INFO(request);
        page.send(request);
        CHECK_THAT(page.next()["error"].get<std::string>(), Catch::Contains("at most 16 ports"));
    }
    page.send(follow(pair.link.name, {"speed", "no such port"}).dump());
    page.send(follow("no-such-link", {"speed"}).dump());
    Plotter(monitor, pair.link.name, writer);
    CHECK(monitor.runs());
}

TEST_CASE("ports of links that the monitor does not show are not followed") {
    const Pair pair, other;
    const auto rings = add_ports(*pair.first, {"speed"}), others = add_ports(*other.first, {"speed"});
    RingWriter writer(rings[0]), hidden(others[0]);
    const RunningMonitor monitor(pair.link.name);
    Plotter page(monitor, pair.link.name, writer);
    Json both = follow(pair.link.name, {"speed"});
    both["follow"].push_back({{"link", other.link.name}, {"owner", "first"}, {"port", "speed"}});
    page.send(both.dump());
    for (int i = 0; i < 20; ++i) {
        hidden.write(bytes_of_number(1), now_ns());
        writer.write(bytes_of_number(0), now_ns());
        for (const auto& sample : page.collect(1)) CHECK(sample[2] == 0);
    }
}

TEST_CASE("a client hears which of its ports are left out, until those of other clients are fewer") {
    const Pair pair;
    std::vector<std::string> names;
    for (int i = 0; i < 66; ++i) names.push_back(fmt::format("port{:02}", i));
    add_ports(*pair.first, names);
    const RunningMonitor monitor(pair.link.name);
    const auto some = [&](std::size_t begin, std::size_t end) {
        return follow(pair.link.name, {names.begin() + begin, names.begin() + end}).dump();
    };
    std::vector<std::unique_ptr<Live>> pages;
    for (std::size_t i = 0; i < 4; ++i) {
        pages.push_back(std::make_unique<Live>(monitor, 0, "/api/samples"));
        pages.back()->send(some(16 * i, 16 * i + 16));
        pages.back()->send(R"({"follow": 0})");
        REQUIRE(pages.back()->next().contains("error")); // the request before it has been read as well
    }
    Live late(monitor, 0, "/api/samples");
    late.send(some(62, 66));
    const Json told = late.next();
    CHECK(told["most"] == 64);
    REQUIRE(told["left_out"].size() == 2);
    CHECK(told["left_out"][0] == Json{{"link", pair.link.name}, {"owner", "first"}, {"port", "port64"}});
    CHECK(told["left_out"][1]["port"] == "port65");
    pages[0]->send(R"({"follow": []})");
    CHECK(late.next()["left_out"].empty());
}

TEST_CASE("messages with an any are not plotted: they may be long beyond their bytes") {
    const Pair pair, other;
    const auto rings = add_ports(*pair.first, {"speed"}), others = add_ports(*other.first, {"speed"}, "v");
    RingWriter writer(rings[0]), anys(others[0]);
    const RunningMonitor monitor(pair.link.name, {other.link.name});
    Plotter page(monitor, pair.link.name, writer);
    Json both = follow(pair.link.name, {"speed"});
    both["follow"].push_back({{"link", other.link.name}, {"owner", "first"}, {"port", "speed"}});
    page.send(both.dump());
    // The type "i" as CDR text, and a block of 4 bytes with the number 1.
    const std::uint32_t any[] = {2, 'i', 4, 1};
    for (int i = 0; i < 20; ++i) {
        anys.write(std::as_bytes(std::span(any)), now_ns());
        writer.write(bytes_of_number(0), now_ns());
        for (const auto& sample : page.collect(1)) CHECK(sample[2] == 0);
    }
}

TEST_CASE("samples are only for the monitor's own page") {
    const Pair pair;
    const RunningMonitor monitor(pair.link.name);
    const std::string upgrade = "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
    for (const char* origin : {"", "Origin: http://example.org\r\n", "Origin: null\r\n"})
        CHECK(get(monitor, "/api/samples", "GET", upgrade + origin).status == 403);
    CHECK(get(monitor, "/api/samples").status == 426);
}
