// SPDX-License-Identifier: Apache-2.0
#include "host/process/run_command.hpp"

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <system_error>
#include <thread>

using namespace std::chrono_literals;
using tandem::process::CommandOptions;
using tandem::process::run_command;

namespace {

tandem::process::CommandResult run_shell(const std::string& script, CommandOptions options = {}) {
    options.capture_report = true;
    return run_command({"/bin/sh", "-c", script}, options);
}

CommandOptions with_timeout(std::chrono::milliseconds timeout) {
    CommandOptions options;
    options.timeout = timeout;
    return options;
}

long open_descriptors() {
    const auto all = std::filesystem::directory_iterator("/proc/self/fd");
    return std::distance(begin(all), end(all));
}

bool has_ended(const std::string& pid) {
    for (int i = 0; i < 3000; ++i) { // init may take a moment to reap it
        if (kill(std::stoi(pid), 0) != 0) return true;
        std::this_thread::sleep_for(10ms);
    }
    return false;
}

} // namespace

TEST_CASE("a command's output, errors, report and exit code are returned") {
    const auto end = run_shell("echo report >&3; echo output; echo error >&2; exit 5");
    CHECK(end.report == "report\n");
    CHECK(end.output == "output\n");
    CHECK(end.errors == "error\n");
    CHECK(end.exit_code() == 5);
    CHECK(end.failure() == "error");
    CHECK_FALSE(end.timed_out);
    CHECK_FALSE(end.succeeded());
}

TEST_CASE("a command killed by a signal is distinguished from one that has exited") {
    const auto end = run_shell("kill -SEGV $$");
    CHECK(end.status.signalled);
    CHECK(end.status.code == SIGSEGV);
    CHECK(end.exit_code() == -1);
    CHECK_THAT(end.failure(), Catch::Contains("was killed by signal 11"));
}

TEST_CASE("the end of a long standard error is kept") {
    CommandOptions options;
    options.max_errors = 4096;
    const auto end = run_shell("head -c 9000 /dev/zero | tr '\\0' x >&2; echo last >&2", options);
    CHECK(end.errors.size() == 4096);
    CHECK(end.errors.substr(4091) == "last\n");
}

TEST_CASE("a command reads its input and runs in its folder") {
    CommandOptions options;
    options.input = "pwd; echo wrong >&2; exit 4\n";
    options.folder = "/";
    const auto end = run_command({"/bin/sh"}, options);
    CHECK(end.output == "/\n");
    CHECK(end.exit_code() == 4);
    CHECK(end.failure() == "wrong");
}

TEST_CASE("merged errors keep their place in the output") {
    CommandOptions options;
    options.merge_errors = true;
    const auto end = run_shell("echo one; echo two >&2; echo three", options);
    CHECK(end.output == "one\ntwo\nthree\n");
    CHECK(end.errors.empty());
}

TEST_CASE("a command that writes without end is killed") {
    CommandOptions options;
    options.max_output = 1 << 20;
    CHECK(run_shell("yes", options).timed_out);
    CHECK(run_shell("yes >&3", options).timed_out);
}

TEST_CASE("a command that does not end is killed and so are its own children") {
    const auto end = run_shell("sleep 1000 & echo $! >&3; wait", with_timeout(1s));
    CHECK(end.timed_out);
    CHECK(has_ended(end.report));
}

TEST_CASE("a grandchild that holds the pipes open does not block the caller, and is killed") {
    const auto end = run_shell("sleep 1000 & echo $! >&3");
    CHECK_FALSE(end.timed_out);
    CHECK(has_ended(end.report));
}

TEST_CASE("a signal to this process ends the command and not this process when the caller asks for it") {
    CommandOptions options;
    options.stop_on_signal = true;
    const auto end = run_shell("kill -HUP $PPID; sleep 1000", options);
    CHECK(end.stop_signal == SIGHUP);
    CHECK_THAT(end.failure(), Catch::StartsWith("was ended by a signal: "));
}

TEST_CASE("a command that cannot be started is an error that names it") {
    CHECK_THROWS_WITH(run_command({"/no/such/program"}),
                      Catch::Contains("/no/such/program cannot be started: No such"));
    CHECK_THROWS_AS(run_command({"/no/such/program"}), std::system_error);
}

TEST_CASE("commands leave no descriptors behind") {
    run_shell("exit 0");
    const auto before = open_descriptors();
    for (int i = 0; i < 20; ++i) run_shell("echo x >&3");
    CHECK_THROWS(run_command({"/no/such/program"}));
    run_shell("sleep 1000", with_timeout(10ms));
    CHECK(open_descriptors() == before);
}
