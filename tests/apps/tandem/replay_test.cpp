// SPDX-License-Identifier: Apache-2.0
// Recordings of the wheelchair, replayed in the place of one of its hosts.
#include "apps/tandem/mcap/file_sink.hpp"
#include "apps/tandem/mcap/reader.hpp"
#include "apps/tandem/record/recorder.hpp"
#include "apps/tandem/replay/comparison.hpp"
#include "apps/tandem/replay/recording.hpp"
#include "followed_link.hpp"
#include "host/process/run_command.hpp"
#include "peer_host.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

using namespace tandem;
using namespace tandem::command;
using namespace tandem::test;

namespace {

namespace fs = std::filesystem;

/// A folder of this test, removed at the end of the scope.
struct TestFolder {
    fs::path path = fs::temp_directory_path() / ("replay-" + std::to_string(getpid()));
    TestFolder() { fs::create_directories(path); }
    ~TestFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    std::string operator/(const std::string& name) const { return (path / name).string(); }
};

/// A lock-step of the wheelchair, recorded; its folder stays for the replay.
void record_wheelchair(const TestFolder& folder, const std::string& configuration,
                       const std::string& scenario) {
    const auto run =
        process::run_command({WHEELCHAIR_PROGRAM, "--lockstep", "--config", configuration, "--scenario",
                              scenario, "--keep", folder / "run", "--record", folder / "run.mcap"});
    INFO(run.errors);
    REQUIRE(run.exit_code() == 0);
}

Result replay_in_place_of(const TestFolder& folder, const std::string& who,
                          std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"replay", folder / "run.mcap", "--in-place-of", who, "--lockstep", folder / "run"});
    return tandem_program(options);
}

/// How a copy of a recording differs from the recording.
struct Changes {
    std::uint64_t most_ns = 0;        ///< later messages are left out
    std::uint64_t time_factor = 1;    ///< multiplies the times
    bool with_steps = true;           ///< without them, it looks like a recording in real time
    std::string repeated_topic_end{}; ///< each message of a topic with this end is written ten times
};

/// Replaces the recording of the folder by a changed copy. Returns the number of messages that were repeated.
int change_recording(const TestFolder& folder, const Changes& changes) {
    mcap::McapReader reader(folder / "run.mcap");
    mcap::FileSink sink(folder / "other.mcap");
    mcap::McapWriter writer(sink, {.library = "test"});
    for (const auto& index : reader.contents().metadata) {
        const auto metadata = reader.metadata(index);
        if (changes.with_steps || metadata.name != "tandem.lockstep")
            writer.add_metadata(metadata.name, metadata.metadata);
    }
    std::map<std::uint16_t, std::uint16_t> schemas{{0, 0}}, channels;
    for (const auto& [id, schema] : reader.contents().schemas)
        schemas[id] = writer.add_schema(schema.name, schema.encoding, schema.data);
    for (const auto& [id, channel] : reader.contents().channels)
        if (changes.with_steps || !channel.topic.ends_with("/steps"))
            channels[id] = writer.add_channel(channel.topic, schemas.at(channel.schema_id),
                                              channel.message_encoding, channel.metadata);
    int repeated = 0;
    auto messages = reader.messages({.to = changes.most_ns, .in_log_time_order = true});
    while (const auto message = messages.next()) {
        if (!channels.contains(message->channel_id)) continue;
        const std::string& topic = reader.contents().channels.at(message->channel_id).topic;
        const bool is_repeated =
            !changes.repeated_topic_end.empty() && topic.ends_with(changes.repeated_topic_end);
        for (int i = 0; i < (is_repeated ? 10 : 1); ++i)
            writer.write(channels.at(message->channel_id), message->sequence,
                         message->log_time * changes.time_factor, message->publish_time, message->data);
        repeated += is_repeated ? 1 : 0;
    }
    writer.close();
    sink.close();
    fs::rename(folder / "other.mcap", folder / "run.mcap");
    return repeated;
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

link::Port port_of(const std::string& name, link::PortKind kind) {
    link::Port port = timed_double_port(name);
    port.kind = kind;
    return port;
}

} // namespace

TEST_CASE("a recorded doorway run replays in lock-step byte for byte in place of either host") {
    const TestFolder folder;
    record_wheelchair(folder, "split", "doorway");
    // The chair answers the recorded voltages; then the control law answers the recorded speeds.
    for (const std::string who : {"rtm_host", "opros_host", "ControlComp0"}) {
        const auto result = replay_in_place_of(folder, who, {"--check"});
        INFO(who << ": " << result.output << result.errors);
        CHECK(result.exit_code == 0);
        CHECK(result.output_contains("in 1351 ticks\n"));
        CHECK(result.output_contains(" answers are the same, byte for byte\n"));
        CHECK_FALSE(result.output_contains("note: "));
    }
}

TEST_CASE("the recorded joystick replays in lock-step byte for byte") {
    const TestFolder folder;
    record_wheelchair(folder, "mixed", "doorway");
    for (const std::string who : {"rtm_host", "opros_host"}) {
        const auto result = replay_in_place_of(folder, who, {"--check"});
        INFO(who << ": " << result.output << result.errors);
        CHECK(result.exit_code == 0);
        CHECK(result.output_contains(" answers are the same, byte for byte\n"));
    }
}

TEST_CASE("a replay waits once for a topic whose answers are missing, and not in each tick") {
    const TestFolder folder;
    record_wheelchair(folder, "split", "doorway");
    const int repeated =
        change_recording(folder, {.most_ns = 300'000'000, .repeated_topic_end = "/refVoltage"});
    REQUIRE(repeated > 10);
    const auto result = replay_in_place_of(folder, "opros_host", {"--check"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(count_of(result.errors, "/refVoltage: no answer within 1 s") == 1);
    CHECK(result.output_contains("in 31 ticks\n"));
}

TEST_CASE("a replay in lock-step with --rate takes as long as the recording") {
    const TestFolder folder;
    record_wheelchair(folder, "split", "doorway");
    const auto expect_paced = [&](const std::string& ticks) {
        const auto begin = std::chrono::steady_clock::now();
        const auto result = replay_in_place_of(folder, "opros_host", {"--rate", "1"});
        INFO(result.output << result.errors);
        CHECK(result.exit_code == 0);
        CHECK(result.output_contains("in " + ticks + " ticks\n"));
        CHECK(std::chrono::steady_clock::now() - begin >= std::chrono::seconds(6));
    };
    SECTION("of a lock-step") {
        change_recording(folder, {.most_ns = 300'000'000, .time_factor = 20});
        expect_paced("31");
    }
    SECTION("in real time") {
        change_recording(folder, {.most_ns = 300'000'000, .time_factor = 20, .with_steps = false});
        expect_paced("601");
    }
}

TEST_CASE("a changed gain is found, with tick and member") {
    const TestFolder folder;
    record_wheelchair(folder, "split", "doorway");
    std::ofstream(folder / "run/rtm/ControlComp0.conf", std::ios::app) << "conf.default.ratio_gain: 15\n";
    const auto result = replay_in_place_of(folder, "opros_host", {"--check"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 1);
    // On a straight line the ratio is correct with any gain, so only the first curve shows a difference.
    const auto line = result.output.find("first difference: tick ");
    REQUIRE(line != std::string::npos);
    const std::string rest = result.output.substr(line + std::string("first difference: tick ").size());
    const int tick = std::stoi(rest);
    CHECK(tick > 10);
    CHECK(rest.find("/refVoltage: data[2] was ") < rest.find('\n'));
    CHECK(rest.find(" answers differ\n") != std::string::npos);
}

TEST_CASE("a replay into a system with changed types ends with both signatures") {
    const TestFolder folder;
    record_wheelchair(folder, "split", "doorway");
    SECTION("of a port behind a link, in place of opros_host") {
        mcap::McapReader reader(folder / "run.mcap");
        mcap::FileSink sink(folder / "other.mcap");
        mcap::McapWriter writer(sink, {.library = "test"});
        for (const auto& index : reader.contents().metadata) {
            auto metadata = reader.metadata(index);
            if (metadata.name == "tandem.ports" && metadata.metadata["side"] == "second") {
                auto table = link::decode_port_table_text(metadata.metadata["table"]);
                for (auto& port : table.ports)
                    if (port.name == "refVoltage") port.signature = "{tm}({sec}u{nsec}u){data}af";
                metadata.metadata["table"] = encode_as_text(table);
            }
            writer.add_metadata(metadata.name, metadata.metadata);
        }
        writer.close();
        sink.close();
        fs::rename(folder / "other.mcap", folder / "run.mcap");
        const auto result = replay_in_place_of(folder, "opros_host", {"--check"});
        INFO(result.output << result.errors);
        CHECK(result.exit_code == 1);
        CHECK(
            result.errors.find("port 'refVoltage' of ControlComp0 was recorded with type "
                               "{tm}({sec}u{nsec}u){data}af, but now has type {tm}({sec}u{nsec}u){data}ad") !=
            std::string::npos);
    }
    SECTION("no host is running, nothing to replace, unknown component") {
        const auto nobody = tandem_program({"replay", folder / "run.mcap"});
        CHECK(nobody.exit_code == 1);
        CHECK(nobody.errors.find("no host is running; start the host that stays") != std::string::npos);
        const auto component = replay_in_place_of(folder, "Nobody", {});
        CHECK(component.exit_code == 1);
        CHECK(component.errors.find("it has opros_host, rtm_host, ControlComp0\n") != std::string::npos);
        fs::remove_all(folder / "run/rtm");
        const auto nothing = replay_in_place_of(folder, "opros_host", {});
        CHECK(nothing.exit_code == 1);
        CHECK(nothing.errors.find("has only opros_host") != std::string::npos);
    }
}

TEST_CASE("a replay in real time sends the recorded messages in order to the running host") {
    const TestFolder folder;
    FollowedLink recorded({port_of("temperature", link::PortKind::data_out)});
    {
        mcap::FileSink sink(folder / "run.mcap");
        mcap::McapWriter writer(sink, {.library = "test"});
        Recorder recorder(writer, {recorded.name()}, {});
        recorder.poll();
        for (std::uint32_t second = 1; second <= 50; ++second)
            recorded.send("temperature", second, second / 2.0);
        recorder.poll();
        writer.close();
        sink.close();
    }
    // Both sides are this process: the replay finds them there.
    const auto taken = tandem_program({"replay", folder / "run.mcap"});
    CHECK(taken.exit_code == 1);
    CHECK(taken.errors.find("are both running; stop the one that the replay replaces") != std::string::npos);
    const auto held = tandem_program({"replay", folder / "run.mcap", "--in-place-of", "opros_host"});
    CHECK(held.exit_code == 1);
    CHECK(held.errors.find("opros_host, which the replay replaces, is still running") != std::string::npos);
    // A link of another name, on whose other side an RTM host would be.
    const shm::test::Link link;
    PeerHost peer(link.name);
    const std::string file = folder / "run.mcap"; // not in the child: threads of this process may hold locks
    shm::test::Child replay([&] {
        execl(TANDEM_PROGRAM, "tandem", "replay", file.c_str(), "--link", link.name.c_str(), "--in-place-of",
              "opros_host", "--rate", "0", nullptr);
        return 98;
    });
    CHECK(shm::test::eventually([&] { return peer.values().size() == 50; }));
    std::optional<int> code;
    CHECK(shm::test::eventually([&] { return (code = replay.ended()).has_value(); }));
    CHECK(code == 0);
    const auto values = peer.values();
    for (std::size_t i = 0; i < values.size(); ++i) CHECK(values[i] == (static_cast<double>(i) + 1) / 2);
    CHECK(peer.was_activated());
    CHECK(peer.was_deactivated());
    const auto unchecked = tandem_program({"replay", folder / "run.mcap", "--link", link.name,
                                           "--in-place-of", "opros_host", "--rate", "0", "--check"});
    CHECK(unchecked.exit_code == 1);
    CHECK(unchecked.output_contains("nothing was compared"));
}

TEST_CASE("a topic that was waited for in vain is waited for again once it has caught up") {
    RecordedChannel slow{RecordedChannel::Kind::message, "l", "slow", "/l/slow"};
    RecordedChannel other{RecordedChannel::Kind::message, "l", "other", "/l/other"};
    slow.type = other.type = wire::parse_signature("{data}d");
    Comparison check(false);
    CHECK_FALSE(check.is_waiting());
    check.expect(slow, 1, {});
    CHECK(check.is_waiting());
    CHECK(check.stop_waiting() == std::vector<std::string>{"/l/slow"});
    CHECK_FALSE(check.is_waiting());
    CHECK_FALSE(check.is_complete());
    check.expect(slow, 2, {});
    CHECK_FALSE(check.is_waiting());
    check.expect(other, 1, {});
    CHECK(check.is_waiting());
    check.receive("/l/other", 1, {});
    CHECK_FALSE(check.is_waiting());
    check.receive("/l/slow", 1, {});
    check.receive("/l/slow", 2, {});
    CHECK(check.is_complete());
    check.expect(slow, 3, {});
    CHECK(check.is_waiting());
}

TEST_CASE("differences are named by member, missing messages are counted") {
    RecordedChannel channel{RecordedChannel::Kind::message, "l", "speed", "/l/speed"};
    channel.type = wire::parse_signature("{tm}({sec}u{nsec}u){wheels}({left}d{right}ad)");
    channel.timed = true;
    const auto message = [](double left, std::vector<double> right) {
        std::vector<std::byte> bytes;
        wire::CdrWriter out(bytes);
        out.put(left);
        out.put_sequence(right.data(), right.size());
        return bytes;
    };
    Comparison check(false);
    check.set_tick(7);
    check.expect(channel, 1, message(1, {2, 3}));
    CHECK_FALSE(check.is_complete());
    check.receive("/l/speed", 2, message(1, {2, 3}));
    CHECK(check.is_complete());
    CHECK(check.same() == 1);
    check.set_tick(8);
    check.expect(channel, 1, message(1, {2, 3}));
    check.receive("/l/speed", 1, message(1, {2, 4}));
    CHECK(check.first_difference() == "tick 8, message 2 of /l/speed: wheels.right[1] was 3.0 and is 4.0");
    check.expect(channel, 1, message(1, {2, 3}));
    check.finish(true);
    CHECK(check.different() == 2);
    Comparison times(true);
    times.expect(channel, wire::pack_time(1, 2), message(1, {}));
    times.receive("/l/speed", wire::pack_time(1, 3), message(1, {}));
    CHECK(times.first_difference() == "message 1 of /l/speed: tm.nsec was 2 and is 3");
    Comparison missing(false);
    missing.expect(channel, 1, message(1, {}));
    missing.finish(true);
    CHECK(missing.first_difference() == "/l/speed: 1 missing from the replay");
}
