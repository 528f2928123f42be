// SPDX-License-Identifier: Apache-2.0
// Recordings do not destroy files when they begin, and keep the recorded messages however they end.
#include "apps/tandem/mcap/check_file.hpp"
#include "apps/tandem/mcap/reader.hpp"
#include "apps/tandem/record/lockstep_recording.hpp"
#include "apps/tandem/record/recording_output.hpp"
#include "followed_link.hpp"
#include "shell.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sys/resource.h>

using namespace tandem;
using namespace tandem::command;
using namespace tandem::test;
namespace fs = std::filesystem;

namespace {

struct Folder {
    Folder() {
        std::string name = (fs::temp_directory_path() / "tandem-recording-XXXXXX").string();
        path = mkdtemp(name.data());
        file = path / "run.mcap";
    }
    ~Folder() { fs::remove_all(path); }
    fs::path path, file;
};

std::uint64_t messages_in(const fs::path& file) {
    return mcap::McapReader(file).contents().statistics.message_count;
}

/// The file is closed, and complete by the rules of the format.
void check_closed(const fs::path& file) {
    for (const auto& finding : mcap::check_file(file)) FAIL_CHECK(finding.line);
    CHECK(mcap::McapReader(file).contents().complete);
}

/// `tandem record` of a link, as a child.
shm::test::Child recorder_of(const FollowedLink& link, const fs::path& file) {
    return shm::test::Child([&] {
        execl(TANDEM_PROGRAM, "tandem", "record", link.name().c_str(), "-o", file.c_str(), nullptr);
        return 98;
    });
}

/// Sends until the file has messages.
void record_some(FollowedLink& link, const fs::path& file, std::uint32_t& second) {
    REQUIRE(shm::test::eventually([&] {
        link.send("temperature", ++second, 1);
        std::error_code missing;
        return fs::file_size(file, missing) > 2000 && !missing && messages_in(file) > 10;
    }));
}

long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

} // namespace

TEST_CASE("a second recorder of a file is refused, and the first one loses nothing") {
    const Folder folder;
    FollowedLink link({timed_double_port("temperature")});
    std::uint32_t second = 0;
    auto first = recorder_of(link, folder.file);
    record_some(link, folder.file, second);
    const auto other =
        tandem_program({"record", link.name(), "-o", folder.file.string(), "--duration", "0.1"});
    CHECK(other.exit_code == 1);
    CHECK(other.errors ==
          "tandem: " + folder.file.string() + " is being written by another program: give another file\n");
    kill(first.pid(), SIGTERM);
    CHECK(first.wait() == 0);
    check_closed(folder.file);
    CHECK(std::distance(fs::directory_iterator(folder.path), {}) == 1);
}

TEST_CASE("Ctrl-C, kill and the end of the terminal close a recording") {
    const int number = GENERATE(SIGINT, SIGTERM, SIGHUP);
    INFO(strsignal(number));
    const Folder folder;
    FollowedLink link({timed_double_port("temperature")});
    std::uint32_t second = 0;
    auto recording = recorder_of(link, folder.file);
    record_some(link, folder.file, second);
    kill(recording.pid(), number);
    CHECK(recording.wait() == 0);
    check_closed(folder.file);
}

TEST_CASE("a recording under nohup outlives its terminal") {
    const Folder folder;
    FollowedLink link({timed_double_port("temperature")});
    std::uint32_t second = 0;
    shm::test::Child recording([&] {
        std::signal(SIGHUP, SIG_IGN); // as nohup(1) does
        execl(TANDEM_PROGRAM, "tandem", "record", link.name().c_str(), "-o", folder.file.c_str(), nullptr);
        return 98;
    });
    record_some(link, folder.file, second);
    kill(recording.pid(), SIGHUP);
    const auto before = messages_in(folder.file);
    CHECK(shm::test::eventually([&] {
        link.send("temperature", ++second, 1);
        return messages_in(folder.file) > before + 10;
    }));
    kill(recording.pid(), SIGTERM);
    CHECK(recording.wait() == 0);
}

TEST_CASE("a recording that reaches the limit of file sizes is closed, and one line says what is lost") {
    const Folder folder;
    FollowedLink link({timed_double_port("temperature")});
    const fs::path errors = folder.path / "errors";
    shm::test::Child recording([&] {
        const rlimit limit{5'000'000, 5'000'000}; // several chunks
        setrlimit(RLIMIT_FSIZE, &limit);
        if (std::freopen(errors.c_str(), "w", stderr) == nullptr) return 97;
        execl(TANDEM_PROGRAM, "tandem", "record", link.name().c_str(), "-o", folder.file.c_str(),
              "--compression", "none", nullptr);
        return 98;
    });
    std::uint32_t second = 0;
    std::optional<int> code;
    CHECK(shm::test::eventually(
        [&] {
            link.send("temperature", ++second, 1);
            code = recording.ended();
            return code.has_value();
        },
        std::chrono::minutes(3)));
    CHECK(code == 1);
    std::ifstream in(errors);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    CHECK(lines(text) == 1);
    CHECK_THAT(text, Catch::Contains(folder.file.string() + " cannot be written: File too large; the "
                                                            "recording ends there: it has ") &&
                         Catch::Contains(" are lost\n"));
    check_closed(folder.file);
    CHECK(messages_in(folder.file) > 100);
}

TEST_CASE("a closed pipe behind the output of a recorder does not cost the recording") {
    const Folder folder;
    const FollowedLink link({timed_double_port("temperature")});
    const std::string record =
        TANDEM_PROGRAM " record " + link.name() + " -o " + folder.file.string() + " --duration 0.3";
    // The reader is gone before the recorder writes to it.
    const auto output = shell("(sleep 0.2; exec " + record + ") | true; exit ${PIPESTATUS[0]}");
    CHECK(output.exit_code == 1);
    CHECK_THAT(output.output, Catch::Contains("standard output cannot be written: Broken pipe"));
    check_closed(folder.file);
}

TEST_CASE("a recording of links that do not exist is an error and leaves no file") {
    const Folder folder;
    const auto none =
        tandem_program({"record", "no-such-link", "-o", folder.file.string(), "--duration", "0.1"});
    CHECK(none.exit_code == 1);
    CHECK_THAT(none.errors, Catch::Contains("link no-such-link did not exist"));
    CHECK_FALSE(fs::exists(folder.file));
    const FollowedLink link({timed_double_port("temperature")});
    const auto one = tandem_program(
        {"record", link.name(), "no-such-link", "-o", folder.file.string(), "--duration", "0.1"});
    CHECK(one.exit_code == 1);
    CHECK_THAT(one.errors, Catch::Contains("link no-such-link did not exist during the recording"));
    check_closed(folder.file);
}

TEST_CASE("a recording whose program ends with an exception is closed, or removed if it is empty") {
    const Folder folder;
    for (const bool any : {false, true}) {
        {
            RecordingOutput output(folder.file.string(), {.library = "test"});
            const auto channel = output.writer().add_channel("topic", 0, "cdr");
            if (any) output.writer().write(channel, 1, 1, 1, {});
        }
        CHECK(fs::exists(folder.file) == any);
    }
    check_closed(folder.file);
}

TEST_CASE("a recording on a disk that was full from the start leaves no file") {
    const Folder folder;
    shm::test::Child child([&] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{10, 10};
        setrlimit(RLIMIT_FSIZE, &limit);
        RecordingOutput output(folder.file.string(), {.library = "test"});
        const auto channel = output.writer().add_channel("topic", 0, "cdr");
        try {
            output.writer().write(channel, 1, 1, 1, {});
            output.close();
        } catch (const mcap::Error& error) {
            const std::string line = error.what();
            return line.find("File too large; nothing was recorded") == std::string::npos ? 2 : 0;
        }
        return 1;
    });
    CHECK(child.wait() == 0);
    CHECK_FALSE(fs::exists(folder.file));
}

TEST_CASE("a lock-step recording refuses a file that exists, before the hosts start") {
    const Folder folder;
    std::ofstream(folder.file) << "a recording of yesterday";
    CHECK_THROWS_WITH(LockstepRecording(folder.file.string()), Catch::Contains("already exists"));
}
