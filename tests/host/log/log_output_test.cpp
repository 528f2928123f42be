// SPDX-License-Identifier: Apache-2.0
// The log of a program that keeps running although its disk is full for a while or its reader stops reading.
#include "host/log/log_output.hpp"

#include "host/log/log.hpp"
#include "host/log/output_failures.hpp"
#include "tests/shm/fixture.hpp"

#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <regex>
#include <sys/resource.h>
#include <sys/stat.h>

using Catch::Contains;
using tandem::log::LogOutput;

namespace {

using tandem::shm::FileDescriptor;

/// A file with a limit of bytes, like a full disk, until enlarge(). The limit is that of the process and ends
/// with the scope.
class LimitedFile {
  public:
    explicit LimitedFile(rlim_t bytes) {
        tandem::log::outlive_output_failures();
        path_ = (std::filesystem::temp_directory_path() / "tandem-log-XXXXXX").string();
        descriptor_ = FileDescriptor(mkstemp(path_.data()));
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~LimitedFile() {
        enlarge();
        std::filesystem::remove(path_);
    }
    LimitedFile(const LimitedFile&) = delete;
    LimitedFile& operator=(const LimitedFile&) = delete;
    void enlarge() const { setrlimit(RLIMIT_FSIZE, &before_); }
    int get() const { return descriptor_.get(); }
    std::string content() const {
        std::ifstream in(path_);
        return {std::istreambuf_iterator<char>(in), {}};
    }

  private:
    std::string path_;
    FileDescriptor descriptor_;
    rlimit before_{};
};

struct Pipe {
    Pipe() {
        int ends[2];
        REQUIRE(pipe2(ends, O_CLOEXEC) == 0);
        reader = FileDescriptor(ends[0]);
        writer = FileDescriptor(ends[1]);
    }
    /// Returns the present content.
    std::string take() const {
        std::string text(4 << 20, ' ');
        const auto count = read(reader.get(), text.data(), text.size());
        return text.substr(0, count > 0 ? static_cast<std::size_t>(count) : 0);
    }
    FileDescriptor reader, writer;
};

} // namespace

TEST_CASE("lines lost on a full disk are counted, and reported once when the disk has room again") {
    const LimitedFile file(15);
    LogOutput log(file.get(), "tandem run");
    CHECK(log.write("first\n"));
    CHECK(log.write("second\nthird\nfourth\n")); // the third line does not fit
    CHECK(log.missing() == 2);
    CHECK(log.write("fifth\n"));
    CHECK(log.missing() == 3);
    CHECK_THAT(log.notice(), Contains("3 lines of the log could not be written"));
    file.enlarge();
    CHECK(log.write("sixth\n"));
    CHECK(log.missing() == 0);
    CHECK(log.write("seventh\n"));
    CHECK(file.content() ==
          "first\nsecond\nth\ntandem run: 3 lines of the log could not be written (File too large)\n"
          "sixth\nseventh\n");
}

TEST_CASE("lines missing at the end are reported without another line") {
    const LimitedFile file(6);
    LogOutput log(file.get(), "tandem run");
    CHECK(log.write("first\nsecond\n"));
    CHECK(log.write("")); // still full
    CHECK(log.missing() == 1);
    file.enlarge();
    CHECK(log.write(""));
    CHECK(log.missing() == 0);
    CHECK_THAT(file.content(), Contains("tandem run: 1 lines of the log could not be written"));
}

TEST_CASE("the end of a log reports the lines that are missing") {
    const LimitedFile file(6);
    {
        LogOutput log(file.get(), "tandem run");
        CHECK(log.write("first\nsecond\n"));
        file.enlarge();
    }
    CHECK_THAT(file.content(), Contains("tandem run: 1 lines of the log could not be written"));
}

TEST_CASE("a flush of the log of a host reports the lines that are missing") {
    const LimitedFile file(6);
    tandem::shm::test::Child host([&] {
        if (dup2(file.get(), STDERR_FILENO) < 0) return 1;
        tandem::log::open("rtm_host");
        tandem::log::print("first");
        tandem::log::print("second");
        file.enlarge();
        tandem::log::flush();
        return 42;
    });
    CHECK(host.wait() == 42);
    CHECK_THAT(file.content(), Contains("rtm_host: 1 lines of the log could not be written"));
}

TEST_CASE(
    "a FIFO whose reader restarts gets the number of the lines that it has missed, and the next lines") {
    tandem::log::outlive_output_failures();
    const auto path =
        (std::filesystem::temp_directory_path() / ("tandem-fifo-" + std::to_string(getpid()))).string();
    REQUIRE(mkfifo(path.c_str(), 0600) == 0);
    const auto open_reader = [&] {
        return FileDescriptor(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    };
    Pipe pipe;
    pipe.reader = open_reader();
    pipe.writer = FileDescriptor(open(path.c_str(), O_WRONLY | O_CLOEXEC));
    LogOutput log(pipe.writer.get(), "tandem run");
    CHECK(log.write("first\n"));
    pipe.reader = FileDescriptor();
    CHECK_FALSE(log.write("second\n"));
    CHECK_FALSE(log.write("third\n"));
    pipe.reader = open_reader();
    CHECK(log.write("fourth\n"));
    CHECK_THAT(
        pipe.take(),
        Contains("tandem run: 2 lines of the log could not be written (no process reads it)\nfourth\n"));
    std::filesystem::remove(path);
}

TEST_CASE("a reader that stops reading blocks no writer, and gets a line about missed lines") {
    const Pipe pipe;
    LogOutput log(pipe.writer.get(), "tandem run");
    const std::string line(999, 'x');
    std::uint64_t lines = 0;
    for (; log.missing() == 0 && lines < 4000; ++lines) CHECK(log.write(line + "\n"));
    CHECK(log.missing() == 1);
    for (int i = 0; i < 1000; ++i) log.write("more\n"); // a second each would take too long
    CHECK(log.missing() == 1001);
    CHECK(pipe.take().size() > 1000);
    CHECK(log.write("read again\n"));
    CHECK(log.missing() == 0);
    CHECK_THAT(pipe.take(),
               Contains("tandem run: 1001 lines of the log could not be written (no process reads it)\n"
                        "read again\n"));
}

TEST_CASE("a terminal that takes only part of the lines blocks no writer") {
    tandem::shm::test::Child writer([] {
        alarm(60);
        const FileDescriptor terminal(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)); // nobody reads it
        if (grantpt(terminal.get()) != 0 || unlockpt(terminal.get()) != 0) return 1;
        const FileDescriptor stream(open(ptsname(terminal.get()), O_RDWR | O_NOCTTY | O_CLOEXEC));
        LogOutput log(stream.get(), "tandem run", std::chrono::milliseconds(0));
        for (int i = 0; i < 100; ++i) log.write(std::string(999, 'x') + "\n");
        return log.missing() > 0 ? 42 : 2;
    });
    CHECK(writer.wait() == 42);
}

TEST_CASE("a reader that has gone is distinguished from a full disk") {
    tandem::log::outlive_output_failures();
    Pipe pipe;
    LogOutput log(pipe.writer.get(), "tandem run");
    CHECK(log.write("first\n"));
    pipe.reader = FileDescriptor();
    CHECK_FALSE(log.write("second\n"));
    CHECK(log.missing() == 1);
    const FileDescriptor full(open("/dev/full", O_WRONLY | O_CLOEXEC));
    LogOutput on_full_disk(full.get(), "tandem run");
    CHECK(on_full_disk.write("first\n"));
    CHECK(on_full_disk.missing() == 1);
}

TEST_CASE("the hosts log in the format of RT-Components, with the same names of levels") {
    Pipe log;
    tandem::shm::test::Child host([&] {
        dup2(log.writer.get(), STDERR_FILENO);
        tandem::log::open("opros_host");
        tandem::log::info("one");
        tandem::log::warn("two");
        tandem::log::error("three");
        return 0;
    });
    REQUIRE(host.wait() == 0);
    const std::string lines = log.take(), time = R"(\[\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3}\])";
    INFO(lines);
    CHECK(std::regex_match(lines, std::regex(time + R"( \[info\] opros_host: one\n)" + time +
                                             R"( \[warn\] opros_host: two\n)" + time +
                                             R"( \[error\] opros_host: three\n)")));
}
