// SPDX-License-Identifier: Apache-2.0
// tandem rtm record: OutPorts of a host that is not behind a link.
#include "apps/tandem/mcap/reader.hpp"
#include "host/process/child_process.hpp"
#include "proxy/wire/cdr.hpp"
#include "tests/apps/tandem/program.hpp"
#include "tests/host/rtm/remote_host.hpp"

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

using tandem::test::Result;
using tandem::test::tandem_program;
using namespace std::chrono_literals;

namespace {

/// A host with an active Counter, which sends 1, 2, 3 ..., and a file to record to.
struct Counting {
    Counting() : host("Counter,Reporter", testing::unused_port(), {}) {
        REQUIRE(host.host.wait_for_output("ready\n"));
        std::string name = (std::filesystem::temp_directory_path() / "tandem-rtm-record-XXXXXX").string();
        folder = mkdtemp(name.data());
        file = folder / "run.mcap";
    }
    ~Counting() { std::filesystem::remove_all(folder); }
    std::vector<std::string> command(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"rtm", "record",     "--manager", "127.0.0.1:" + host.port,
                                           "-o",  file.string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }
    Result activate() const {
        return tandem_program({"rtm", "activate", "Counter0", "--manager", "127.0.0.1:" + host.port});
    }
    /// The recorded numbers.
    std::vector<long> numbers() const {
        std::vector<long> found;
        std::istringstream lines(tandem_program({"bag", "convert", file.string(), "--json"}).output);
        for (std::string line; std::getline(lines, line);) {
            const auto json = nlohmann::json::parse(line);
            INFO(line);
            if (json.at("topic") == "/Counter0/out") found.push_back(json.at("value").at("data").get<long>());
        }
        return found;
    }
    /// The recorded counts of messages that the sender's buffer lost.
    std::vector<std::uint64_t> losses() const {
        std::vector<std::uint64_t> found;
        tandem::mcap::McapReader reader(file);
        auto messages = reader.messages();
        while (const auto message = messages.next()) {
            if (reader.contents().channels.at(message->channel_id).topic != "/tandem/drops") continue;
            tandem::wire::CdrReader in(std::span(message->data).subspan(4)); // without its encapsulation
            in.get_string();                                                 // the port
            in.get<std::uint64_t>();                                         // refused
            found.push_back(in.get<std::uint64_t>());
        }
        return found;
    }
    testing::RemoteHost host;
    std::filesystem::path folder, file;
};

/// A `tandem rtm record` that runs until it is ended.
struct Recording {
    explicit Recording(const Counting& counting, std::vector<std::string> more = {})
        : output(std::tmpfile()) {
        auto command = counting.command(more);
        command.insert(command.begin(), TANDEM_PROGRAM);
        tandem::process::ChildOptions options;
        options.output = fileno(output);
        options.errors = fileno(errors.get());
        child.emplace(command, options);
    }
    /// Returns whether its standard error contains the text. Reads without moving the offset at which the child writes.
    bool has_reported(const std::string& text) const {
        std::string all(4096, ' ');
        const ssize_t size = pread(fileno(errors.get()), all.data(), all.size(), 0);
        return size > 0 && all.find(text) != std::string::npos;
    }
    std::FILE* output;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> errors{std::tmpfile(), std::fclose};
    std::optional<tandem::process::ChildProcess> child;
};

/// Returns the content of the file, which is closed.
std::string content_of(std::FILE* file) {
    std::string text;
    std::rewind(file);
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text.push_back(static_cast<char>(c));
    std::fclose(file);
    return text;
}

/// Returns whether the condition on the file becomes true.
bool wait_for(const Counting& counting, const std::function<bool()>& condition) {
    for (int i = 0; i < 600; ++i) {
        if (std::filesystem::exists(counting.file) && condition()) return true;
        std::this_thread::sleep_for(50ms);
    }
    return false;
}

/// Waits until the file has messages.
void wait_for_messages(const Counting& counting) {
    if (!wait_for(counting, [&] { return std::filesystem::file_size(counting.file) > 1000; }))
        FAIL("nothing is recorded");
}

} // namespace

TEST_CASE("tandem rtm record writes each message of an OutPort in the format of tandem record") {
    const Counting counting;
    REQUIRE(counting.activate().exit_code == 0);
    const Result result = tandem_program(counting.command({"Counter0:out", "--duration", "2", "--json"}));
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    const auto numbers = counting.numbers();
    REQUIRE(numbers.size() > 10);
    CHECK(result.json()["messages"] == numbers.size());
    CHECK(result.json()["lost_by_senders"] == 0);
    CHECK(result.json()["not_recorded"] == 0);
    CHECK(numbers.back() - numbers.front() + 1 == static_cast<long>(numbers.size()));
    CHECK(std::is_sorted(numbers.begin(), numbers.end()));
    CHECK(tandem_program({"bag", "check", counting.file.string()}).exit_code == 0);
    const auto info = tandem_program({"bag", "info", counting.file.string(), "--json"}).json();
    REQUIRE(info["topics"].size() == 1);
    CHECK(info["topics"][0]["topic"] == "/Counter0/out");
    CHECK(info["topics"][0]["schema"] == "RTC::TimedLong");
    CHECK(info["complete"] == true);
}

TEST_CASE("messages lost in the sender's buffer while the recorder is slow are counted") {
    const Counting counting;
    REQUIRE(counting.activate().exit_code == 0);
    Recording recording(counting, {"Counter0", "--json", "-p", "outport.buffer.length=4"});
    wait_for_messages(counting);
    kill(recording.child->pid(), SIGSTOP);
    std::this_thread::sleep_for(700ms);
    kill(recording.child->pid(), SIGCONT);
    std::this_thread::sleep_for(1500ms);
    kill(recording.child->pid(), SIGINT);
    REQUIRE(recording.child->wait(30s));
    const auto summary = nlohmann::json::parse(content_of(recording.output));
    const auto numbers = counting.numbers();
    const long lost = summary["lost_by_senders"].get<long>();
    CHECK(lost > 0);
    CHECK(numbers.back() - numbers.front() + 1 == static_cast<long>(numbers.size()) + lost);
    const auto info = tandem_program({"bag", "info", counting.file.string(), "--json"}).json();
    CHECK(info["topics"].size() == 2); // and /tandem/drops
}

TEST_CASE("the count of messages lost in the sender's buffer does not fall when the recorder reconnects") {
    const Counting counting;
    REQUIRE(counting.activate().exit_code == 0);
    Recording recording(counting, {"Counter0", "--json", "-p", "outport.buffer.length=4"});
    wait_for_messages(counting);
    kill(recording.child->pid(), SIGSTOP);
    std::this_thread::sleep_for(700ms);
    kill(recording.child->pid(), SIGCONT);
    REQUIRE(wait_for(counting, [&] { return !counting.losses().empty(); }));
    const auto disconnected =
        tandem_program({"rtm", "disconnect", "Counter0:out", "--manager", "127.0.0.1:" + counting.host.port});
    INFO(disconnected.output << disconnected.errors);
    REQUIRE(disconnected.exit_code == 0);
    CHECK(wait_for(counting, [&] { return recording.has_reported("dropped the connection; reconnected"); }));
    kill(recording.child->pid(), SIGINT);
    REQUIRE(recording.child->wait(30s));
    const auto summary = nlohmann::json::parse(content_of(recording.output));
    const auto losses = counting.losses();
    REQUIRE(!losses.empty());
    CHECK(losses.front() > 0);
    CHECK(std::is_sorted(losses.begin(), losses.end()));
    CHECK(summary["lost_by_senders"] == losses.back());
}

TEST_CASE("a killed tandem rtm record leaves a readable file, and the recorded port continues") {
    const Counting counting;
    REQUIRE(counting.activate().exit_code == 0);
    {
        Recording recording(counting);
        wait_for_messages(counting);
        recording.child->kill();
        std::fclose(recording.output);
    }
    CHECK(!counting.numbers().empty());
    std::filesystem::remove(counting.file);
    const Result result = tandem_program(counting.command({"Counter0:out", "--duration", "1"}));
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    CHECK(counting.numbers().size() > 10);
}

TEST_CASE("tandem rtm record reports in one line what it cannot record") {
    const Counting counting;
    const auto failed = [&](const std::vector<std::string>& more) {
        const Result result = tandem_program(counting.command(more));
        INFO(result.output << result.errors);
        CHECK(result.exit_code == 1);
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
        return result.errors;
    };
    CHECK_THAT(failed({"Counter1"}), Catch::Contains("component Counter1 not found"));
    CHECK_THAT(failed({"Counter0:in"}), Catch::Contains("Counter0 has no port in"));
    CHECK_THAT(failed({"Reporter0:in"}), Catch::Contains("expected a DataOutPort"));
    CHECK_THAT(failed({"Reporter0"}), Catch::Contains("Reporter0 has no OutPort"));
    const Result unwritable =
        tandem_program({"rtm", "record", "Counter0", "--manager", "127.0.0.1:" + counting.host.port, "-o",
                        "/no/such/folder/x.mcap"});
    CHECK(unwritable.exit_code == 1);
    CHECK_THAT(unwritable.errors, Catch::Contains("/no/such/folder/x.mcap"));
}
