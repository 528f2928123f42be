// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/file_sink.hpp"
#include "apps/tandem/mcap/reader.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "apps/tandem/record/recorder.hpp"
#include "followed_link.hpp"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <thread>

using namespace tandem;
using namespace tandem::command;
using namespace tandem::test;

namespace {

/// A file of this test, removed at the end of the scope.
struct RecordingFile {
    std::string path =
        (std::filesystem::temp_directory_path() / ("recording-" + std::to_string(getpid()) + ".mcap"))
            .string();
    ~RecordingFile() { std::filesystem::remove(path); }
};

/// The messages of one topic, without their encapsulation header.
std::vector<std::vector<std::byte>> messages_of(mcap::McapReader& reader, const std::string& topic) {
    std::vector<std::vector<std::byte>> messages;
    auto cursor = reader.messages();
    while (const auto message = cursor.next()) {
        if (reader.contents().channels.at(message->channel_id).topic != topic) continue;
        REQUIRE(message->data.size() >= 4);
        messages.emplace_back(message->data.begin() + 4, message->data.end());
    }
    return messages;
}

} // namespace

TEST_CASE("a recording has each message, its type and the number of drops") {
    const RecordingFile file;
    FollowedLink link({timed_double_port("temperature")});
    {
        mcap::FileSink sink(file.path);
        mcap::McapWriter writer(sink, {.library = "test"});
        Recorder recorder(writer, {link.name()}, {});
        recorder.poll();
        for (std::uint32_t second = 1; second <= 5000; ++second) {
            link.send("temperature", second, second / 2.0);
            if (second % 100 == 0) recorder.poll();
        }
        recorder.write_drops();
        CHECK(recorder.messages() == 5000);
        CHECK(recorder.lost() == 0);
        writer.close();
        sink.close();
    }
    mcap::McapReader reader(file.path);
    const auto messages = messages_of(reader, "/" + link.name() + "/temperature");
    REQUIRE(messages.size() == 5000);
    wire::CdrReader in(messages.at(41));
    CHECK(in.get<std::uint32_t>() == 42);
    CHECK(in.get<std::uint32_t>() == 5);
    CHECK(in.get<double>() == 21);
    // Nobody reads, so the ring's writer drops the oldest.
    const auto drops = messages_of(reader, "/" + link.name() + "/tandem/drops");
    REQUIRE(drops.size() == 1);
    wire::CdrReader counts(drops[0]);
    CHECK(counts.get_string() == "temperature");
    CHECK(counts.get<std::uint64_t>() == 0);
    CHECK(counts.get<std::uint64_t>() > 3000);
}

TEST_CASE("a recording has each service call with its arguments and result") {
    const RecordingFile file;
    FollowedLink link({timed_double_port("temperature")});
    const auto call = [&](double argument, shm::CallStatus status, std::span<const std::byte> results) {
        link.call({"heater", "warm", "{to}d:d", std::as_bytes(std::span(&argument, 1))}, status, results);
    };
    const double result = 21.5;
    call(20, shm::CallStatus::ok, std::as_bytes(std::span(&result, 1)));
    {
        mcap::FileSink sink(file.path);
        mcap::McapWriter writer(sink, {.library = "test"});
        Recorder recorder(writer, {link.name()}, {});
        recorder.poll(shm::CallActivity::none); // finds the call before it
        call(30, shm::CallStatus::ok, std::as_bytes(std::span(&result, 1)));
        call(99, shm::CallStatus::exception, command::bytes_of("too warm"));
        link.call({"", "activate", "", {}}, shm::CallStatus::ok, {}); // between the proxies
        recorder.poll(shm::CallActivity::none);
        CHECK(recorder.calls() == 3);
        CHECK(recorder.lost_calls() == 0);
        writer.close();
        sink.close();
    }
    const auto json = tandem_program({"bag", "convert", file.path, "--json"});
    CHECK(json.exit_code == 0);
    std::vector<std::string> lines;
    std::istringstream text(json.output);
    for (std::string line; std::getline(text, line);) {
        const auto message = nlohmann::json::parse(line);
        lines.push_back(message["topic"].get<std::string>().substr(link.name().size() + 2) + " " +
                        message["value"].dump());
    }
    CHECK(
        lines ==
        std::vector<std::string>{
            R"(heater/warm/request {"call":1,"to":20.0})", R"(heater/warm/reply {"call":1,"result":21.5})",
            R"(heater/warm/request {"call":2,"to":30.0})", R"(heater/warm/reply {"call":2,"result":21.5})",
            R"(heater/warm/request {"call":3,"to":99.0})",
            R"(heater/warm/failure {"bytes":"746f6f207761726d","call":3,"status":"exception","text":"too warm"})"});
}

TEST_CASE("a recording is converted to JSON and CSV") {
    const RecordingFile file;
    FollowedLink link({timed_double_port("temperature"), timed_double_port("pressure")});
    {
        mcap::FileSink sink(file.path);
        mcap::McapWriter writer(sink, {.library = "test"});
        Recorder recorder(writer, {link.name()}, {});
        recorder.poll();
        link.send("temperature", 1, 0.5);
        recorder.poll();
        link.send("pressure", 2, 1013);
        recorder.poll();
        writer.close();
        sink.close();
    }
    const std::string topic = "/" + link.name() + "/temperature";
    const auto json = tandem_program({"bag", "convert", file.path, "--json"});
    CHECK(json.exit_code == 0);
    const auto first = nlohmann::json::parse(json.output.substr(0, json.output.find('\n')));
    CHECK(first["topic"] == topic);
    CHECK(first["value"]["data"] == 0.5);
    CHECK(first["publish_time_ns"] == 1'000'000'005);
    CHECK(std::count(json.output.begin(), json.output.end(), '\n') == 2);
    const auto csv = tandem_program({"bag", "convert", file.path, "--csv", "--topic", topic});
    CHECK(csv.output.rfind("log_time_ns,publish_time_ns,sequence,tm.sec,tm.nsec,data\n", 0) == 0);
    CHECK(csv.output_contains(",1000000005,1,1,5,0.5\n"));
    const auto two = tandem_program({"bag", "convert", file.path, "--csv"});
    CHECK(two.exit_code == 1);
    CHECK(two.errors.find("choose one with --topic: ") != std::string::npos);
    const auto unknown = tandem_program({"bag", "convert", file.path, "--json", "--topic", "/x"});
    CHECK(unknown.exit_code == 1);
    CHECK(unknown.errors.find("has no topic /x") != std::string::npos);
}

TEST_CASE("a recording that is killed can be read") {
    const RecordingFile file;
    FollowedLink link({timed_double_port("temperature")});
    shm::test::Child recording([&] {
        execl(TANDEM_PROGRAM, "tandem", "record", link.name().c_str(), "-o", file.path.c_str(), nullptr);
        return 98;
    });
    std::uint32_t second = 0;
    const auto recorded = [&]() -> std::size_t {
        link.send("temperature", ++second, 1);
        std::error_code missing;
        if (std::filesystem::file_size(file.path, missing) < 2000 || missing) return 0;
        mcap::McapReader reader(file.path);
        return messages_of(reader, "/" + link.name() + "/temperature").size();
    };
    CHECK(shm::test::eventually([&] { return recorded() > 100; }));
    recording.kill_now();
    CHECK(recorded() > 100);
}

namespace {

/// Chunks that lie in the file with all of their bytes, by the lengths before its records.
std::size_t complete_chunks(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    std::size_t chunks = 0;
    for (std::size_t at = sizeof mcap::magic; at + mcap::record_head_size <= bytes.size();) {
        std::uint64_t length = 0;
        std::memcpy(&length, bytes.data() + at + 1, sizeof length);
        if (length > bytes.size() - at - mcap::record_head_size) break;
        chunks += bytes[at] == static_cast<char>(mcap::OpCode::chunk) ? 1 : 0;
        at += mcap::record_head_size + length;
    }
    return chunks;
}

/// Starts a recording, sends, and kills the recorder after this time. Returns how many messages the file has.
std::size_t kill_recording(FollowedLink& link, const std::string& path, std::chrono::milliseconds after,
                           std::uint32_t& second) {
    shm::test::Child recording([&] {
        execl(TANDEM_PROGRAM, "tandem", "record", link.name().c_str(), "-o", path.c_str(), nullptr);
        return 98;
    });
    const auto end = std::chrono::steady_clock::now() + after;
    while (std::chrono::steady_clock::now() < end) {
        for (int i = 0; i < 50; ++i) link.send("temperature", ++second, 1);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    recording.kill_now();
    std::error_code missing;
    if (std::filesystem::file_size(path, missing) < 100 || missing) return 0; // killed before it had begun
    mcap::McapReader reader(path);
    CHECK(reader.contents().blocks.size() >= complete_chunks(path));
    const auto messages = messages_of(reader, "/" + link.name() + "/temperature");
    std::uint32_t last = 0;
    for (const auto& message : messages) {
        const auto sent = wire::CdrReader(message).get<std::uint32_t>();
        if (last != 0 && sent <= last) FAIL("message " << sent << " follows " << last);
        last = sent;
    }
    return messages.size();
}

} // namespace

TEST_CASE("a recorder killed at random moments leaves a readable file, and nothing in /dev/shm") {
    const RecordingFile file;
    FollowedLink link({timed_double_port("temperature")});
    const auto shm_files = [] {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator("/dev/shm"))
            if (entry.path().filename().string().find("tandem") != std::string::npos &&
                entry.path().string().find(std::to_string(getpid())) != std::string::npos)
                names.insert(entry.path());
        return names;
    };
    const auto before = shm_files();
    const std::uint64_t kills = shm::test::stress(4, 100);
    std::minstd_rand random(std::random_device{}());
    std::uint32_t second = 0;
    int with_messages = 0;
    for (std::uint64_t kill = 0; kill < kills; ++kill) {
        const auto after = std::chrono::milliseconds(random() % 1500);
        INFO("killed after " << after.count() << " ms");
        with_messages += kill_recording(link, file.path, after, second) > 0 ? 1 : 0;
        std::filesystem::remove(file.path);
    }
    // A recorder that lives long enough has written messages, however slow the machine is.
    for (int more = 1; with_messages == 0 && more <= 10; ++more)
        with_messages += kill_recording(link, file.path, std::chrono::seconds(more), second) > 0 ? 1 : 0;
    CHECK(with_messages > 0);
    CHECK(shm_files() == before);
}

TEST_CASE("record ends at its duration and prints a summary") {
    const RecordingFile file;
    const FollowedLink link({timed_double_port("temperature")});
    const auto result = tandem_program({"record", link.name(), "-o", file.path, "--duration", "0.2"});
    CHECK(result.exit_code == 0);
    CHECK(result.output.rfind(file.path + ": 0 messages of 1 ports and 0 calls in 0.2 s", 0) == 0);
    std::filesystem::remove(file.path);
    const auto absent = tandem_program({"record", "no-such-link", "-o", file.path, "--duration", "0.1"});
    CHECK(absent.exit_code == 1);
    CHECK(absent.errors.rfind("tandem: waiting for link no-such-link; tandem shm list shows existing links\n",
                              0) == 0);
    const auto full = tandem_program({"record", link.name(), "-o", "/dev/full", "--duration", "0.1"});
    CHECK(full.exit_code == 1);
    CHECK(full.errors.find("/dev/full") != std::string::npos);
}

TEST_CASE("record refuses a port that no host of the link has, and leaves no file") {
    const RecordingFile file;
    FollowedLink link({timed_double_port("temperature")});
    const auto record = [&](const std::vector<std::string>& ports) {
        std::vector<std::string> command{"record", link.name(), "-o", file.path, "--duration", "0.1"};
        for (const std::string& port : ports) command.insert(command.end(), {"--port", port});
        return tandem_program(command);
    };
    // The other host has not published its ports, one of which may be meant.
    const auto waited = record({"temprature"});
    CHECK(waited.exit_code == 1);
    CHECK(waited.errors == "tandem: waiting for port 'temprature'; tandem graph shows existing ports\n"
                           "tandem: nothing was recorded and " +
                               file.path + " was not written: link " + link.name() +
                               " has no port 'temprature': the ports are temperature\n");
    CHECK_FALSE(std::filesystem::exists(file.path));
    link.publish_model_of_second("RTM");
    const auto refused = record({"temperature", "temprature"});
    CHECK(refused.exit_code == 1);
    CHECK(refused.errors ==
          "tandem: link " + link.name() + " has no port 'temprature': the ports are temperature\n");
    CHECK(refused.output.empty());
    CHECK_FALSE(std::filesystem::exists(file.path));
    CHECK(record({"temperature"}).exit_code == 0);
}

TEST_CASE("record does not change an existing file") {
    const RecordingFile file;
    const std::string content = "a recording of yesterday";
    std::ofstream(file.path) << content;
    const FollowedLink link({timed_double_port("temperature")});
    const auto unchanged = [&] {
        std::ifstream in(file.path);
        return std::string(std::istreambuf_iterator<char>(in), {}) == content;
    };
    const auto onto_it = tandem_program({"record", link.name(), "-o", file.path, "--duration", "0.1"});
    CHECK(onto_it.exit_code == 1);
    CHECK(onto_it.errors ==
          "tandem: " + file.path + " already exists and is not empty: give another file, or remove it\n");
    CHECK(unchanged());
    const auto bad_name = tandem_program({"record", "bad name!", "-o", file.path, "--duration", "0.1"});
    CHECK(bad_name.exit_code == 1);
    CHECK(bad_name.errors.find("link name 'bad name!'") != std::string::npos);
    CHECK(unchanged());
    std::filesystem::remove(file.path);
    CHECK(tandem_program({"record", "bad name!", "-o", file.path}).exit_code == 1);
    CHECK_FALSE(std::filesystem::exists(file.path));
}
