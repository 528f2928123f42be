// SPDX-License-Identifier: Apache-2.0
// The times of a recording come from one clock and are in order, whatever happens to the wall clock.
#include "apps/tandem/mcap/reader.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "apps/tandem/record/recorder.hpp"
#include "followed_link.hpp"
#include "mcap/sample.hpp"
#include "shm/os/clock.hpp"

#include <algorithm>

using namespace tandem;
using namespace tandem::command;
using namespace tandem::test;

namespace {

constexpr std::int64_t hour_ns = 3'600'000'000'000;

/// A wall clock that the test sets.
struct WallClock {
    std::int64_t set_by_ns = 0;
    RecordingClock clock() {
        return RecordingClock([this] {
            ClockReading reading = read_clocks();
            reading.wall_ns += static_cast<std::uint64_t>(set_by_ns);
            return reading;
        });
    }
};

struct Recorded {
    std::string topic;
    std::uint64_t log_time, publish_time;
    std::vector<std::byte> data;
};

std::vector<Recorded> messages_of(mcap::McapReader& reader) {
    std::vector<Recorded> found;
    auto cursor = reader.messages(); // in the order of the file
    while (const auto message = cursor.next())
        found.push_back({reader.contents().channels.at(message->channel_id).topic,
                         message->log_time,
                         message->publish_time,
                         {message->data.begin(), message->data.end()}});
    return found;
}

bool in_order(const std::vector<Recorded>& messages) {
    return std::is_sorted(messages.begin(), messages.end(),
                          [](const auto& a, const auto& b) { return a.log_time < b.log_time; });
}

} // namespace

TEST_CASE("setting the wall clock changes neither the order nor the pauses of a recording") {
    const std::int64_t step = GENERATE(-hour_ns, hour_ns, -2'000'000, 2'000'000);
    INFO(step << " ns");
    FollowedLink link({timed_double_port("temperature")});
    WallClock wall;
    MemorySink sink;
    mcap::McapWriter writer(sink, {.library = "test"});
    const std::uint64_t begin = wall_clock_ns();
    const std::uint64_t monotonic_begin = shm::now_ns();
    Recorder recorder(writer, {link.name()}, {}, wall.clock());
    recorder.poll();
    for (std::uint32_t i = 1; i <= 6; ++i) {
        if (i == 4) wall.set_by_ns = step;
        link.send("temperature", i, i);
        recorder.poll();
        recorder.write_clock_step();
    }
    writer.close();
    const std::uint64_t took = shm::now_ns() - monotonic_begin;
    CHECK(recorder.clock_steps() == 1);

    const TemporaryFile file(sink.bytes);
    mcap::McapReader reader(file.path());
    auto messages = messages_of(reader);
    REQUIRE(messages.size() == 7);
    CHECK(in_order(messages));
    CHECK(messages.back().log_time - messages.front().log_time <= took);
    // Half a minute: the clock of the machine may itself be set during the test.
    CHECK(messages.front().log_time + 30'000'000'000 > begin);
    const auto found = std::find_if(messages.begin(), messages.end(),
                                    [](const auto& each) { return each.topic == "/tandem/clock"; });
    REQUIRE(found != messages.end());
    CHECK(found - messages.begin() == 4);
    wire::CdrReader in(std::span(found->data).subspan(4));
    CHECK(std::abs(in.get<std::int64_t>() - step) < 1'000'000);
    CHECK(std::abs(in.get<std::int64_t>() - step) < 1'000'000);
}

TEST_CASE("a recording has both clocks at its start") {
    const FollowedLink link({timed_double_port("temperature")});
    MemorySink sink;
    mcap::McapWriter writer(sink, {.library = "test"});
    const std::uint64_t before = shm::now_ns();
    Recorder recorder(writer, {link.name()}, {});
    recorder.poll();
    recorder.write_clock_step();
    writer.close();
    const TemporaryFile file(sink.bytes);
    mcap::McapReader reader(file.path());
    int found = 0;
    for (const auto& index : reader.contents().metadata) {
        if (index.name != "tandem.clock") continue;
        ++found;
        const auto metadata = reader.metadata(index).metadata;
        CHECK(std::stoull(metadata.at("monotonic_ns")) >= before);
        CHECK(std::stoull(metadata.at("wall_ns")) > 1'500'000'000'000'000'000);
    }
    CHECK(found == 1);
    for (const auto& attachment : reader.contents().attachments)
        CHECK(attachment.attachment.log_time > 1'500'000'000'000'000'000);
}

TEST_CASE("a slow change of the wall clock is not a step") {
    WallClock wall;
    RecordingClock clock = wall.clock();
    CHECK(clock.take_step() == 0);
    wall.set_by_ns = 500'000;
    CHECK(clock.take_step() == 0);
    wall.set_by_ns = hour_ns;
    CHECK(clock.take_step() != 0);
    CHECK(clock.take_step() == 0);
    wall.set_by_ns = 0;
    CHECK(std::abs(clock.take_step() + hour_ns) < 1'000'000);
    CHECK(std::abs(clock.offset_ns()) < 1'000'000);
}

TEST_CASE("all times of a lock-step recording are simulated") {
    FollowedLink link({timed_double_port("temperature")});
    WallClock wall;
    MemorySink sink;
    mcap::McapWriter writer(sink, {.library = "test"});
    const double argument = 20;
    const auto call = [&] {
        link.call({"heater", "warm", "{to}d:d", std::as_bytes(std::span(&argument, 1))}, shm::CallStatus::ok,
                  std::as_bytes(std::span(&argument, 1)));
    };
    call(); // creates the queue, which a recorder finds at once only at its start
    Recorder recorder(writer, {link.name()}, {}, wall.clock());
    recorder.begin_with_oldest();
    recorder.set_time(0);
    recorder.poll(shm::CallActivity::none);
    for (std::uint64_t tick = 0; tick < 3; ++tick) {
        link.send("temperature", 1'795'420'800, 1); // stamped by the wall clock
        call();
        recorder.write_step(tick * 10'000'000, tick, "opros_host", "Sensor0");
        recorder.poll(shm::CallActivity::none);
        wall.set_by_ns += hour_ns;
        recorder.write_drops();
        recorder.write_clock_step();
    }
    writer.close();
    const TemporaryFile file(sink.bytes);
    mcap::McapReader reader(file.path());
    const auto messages = messages_of(reader);
    CHECK(messages.size() >= 12);
    for (const auto& message : messages) {
        INFO(message.topic);
        CHECK(message.log_time <= 20'000'000);
        CHECK(message.publish_time == message.log_time);
        CHECK(message.topic != "/tandem/clock");
    }
    for (const auto& attachment : reader.contents().attachments) CHECK(attachment.attachment.log_time == 0);
}
