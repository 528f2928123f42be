// SPDX-License-Identifier: Apache-2.0
#include "host/process/child_process.hpp"

#include "host/process/output_pipe.hpp"
#include "host/process/start_thread.hpp"

#include <catch2/catch.hpp>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <optional>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace std::chrono_literals;
using tandem::process::ChildProcess;
using tandem::process::OutputPipe;

namespace {

std::vector<std::string> shell(const std::string& script) { return {"/bin/sh", "-c", script}; }

bool alive(pid_t pid) { return kill(pid, 0) == 0; }

/// The first line that a child writes, within ten seconds.
std::string read_line(const OutputPipe& pipe) {
    std::string text;
    for (int i = 0; i < 1000 && text.find('\n') == text.npos; ++i) {
        pipe.read_available(text);
        std::this_thread::sleep_for(10ms);
    }
    return text.substr(0, text.find('\n'));
}

} // namespace

TEST_CASE("a child's end is seen by poll and by wait, with its exit code") {
    ChildProcess child(shell("exit 3"));
    REQUIRE(child.wait(30s));
    CHECK(child.poll()->code == 3);
    CHECK(child.poll()->text() == "exited with 3");
    CHECK_FALSE(child.poll()->success());
}

TEST_CASE("a wait for a child that keeps running ends with its timeout") {
    ChildProcess child(shell("exec sleep 1000"));
    CHECK_FALSE(child.wait(10ms));
    CHECK(child.kill());
    CHECK(child.poll()->text() == "was killed by signal 9 (Killed)");
}

TEST_CASE("a child that handles SIGTERM ends cleanly, one that ignores it is killed") {
    OutputPipe pipe;
    ChildProcess polite(shell("trap 'exit 0' TERM; echo ready; while :; do sleep 0.05; done"),
                        {-1, pipe.writer()});
    REQUIRE(read_line(pipe) == "ready");
    REQUIRE(polite.stop(30s));
    CHECK(polite.poll()->success());
    ChildProcess deaf(shell("trap '' TERM; echo ready; while :; do sleep 0.05; done"), {-1, pipe.writer()});
    REQUIRE(read_line(pipe) == "ready");
    REQUIRE(deaf.stop(50ms));
    CHECK(deaf.poll()->signalled);
}

TEST_CASE("a child does not outlive its object, nor its group the child") {
    OutputPipe pipe;
    pid_t child = 0, grandchild = 0;
    {
        ChildProcess process(shell("sleep 1000 & echo $!; wait"), {-1, pipe.writer()});
        child = process.pid();
        grandchild = std::stoi(read_line(pipe));
        CHECK(alive(grandchild));
    }
    CHECK_FALSE(alive(child));
    for (int i = 0; i < 1000 && alive(grandchild); ++i) std::this_thread::sleep_for(10ms);
    CHECK_FALSE(alive(grandchild));
}

TEST_CASE("a forked child can be taken over") {
    const pid_t forked = fork();
    if (forked == 0) _exit(7);
    ChildProcess child(forked);
    REQUIRE(child.wait(30s));
    CHECK(child.poll()->code == 7);
}

TEST_CASE("a child whose exit code was taken by other code of the process has an unknown exit code") {
    ChildProcess child(shell("exit 3"));
    REQUIRE(waitpid(child.pid(), nullptr, 0) == child.pid());
    REQUIRE(child.wait(30s));
    CHECK(child.poll()->code == -1);
    CHECK_FALSE(child.poll()->success());
    CHECK_THAT(child.poll()->text(), Catch::Contains("unknown exit code"));
}

TEST_CASE("a program that cannot be started is named with the cause, and with a remedy if one is known") {
    CHECK_THROWS_WITH(ChildProcess({"/no/such/program"}),
                      "/no/such/program cannot be started: No such file or directory");
    CHECK_THAT(tandem::process::NotStarted(EPERM, "/bin/true cannot be watched").what(),
               Catch::Contains("Operation not permitted: ") &&
                   Catch::Contains("update the container runtime"));
}

TEST_CASE("a child starts with no signal blocked") {
    sigset_t term;
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    sigprocmask(SIG_BLOCK, &term, nullptr);
    ChildProcess child(shell("exec sleep 1000"));
    sigprocmask(SIG_UNBLOCK, &term, nullptr);
    REQUIRE(child.stop(30s));
    CHECK(child.poll()->code == SIGTERM);
}

// Connections that a library has accepted, for example, stay open at the other end as long as any process has them.
TEST_CASE("a child has only the descriptors that it is given, even if others are inheritable") {
    int ends[2];
    REQUIRE(pipe(ends) == 0); // without O_CLOEXEC
    const int high = fcntl(ends[0], F_DUPFD, 200);
    OutputPipe pipe;
    // Without the one by which the shell reads the folder.
    const auto list = shell("for fd in /proc/$$/fd/*; do [ -e $fd ] && printf '%s ' ${fd##*/}; done; echo");
    ChildProcess child(list, {-1, pipe.writer()});
    CHECK(read_line(pipe) == "0 1 2 ");
    ChildProcess reporting(list, {-1, pipe.writer(), -1, "", ends[1]});
    CHECK(read_line(pipe) == "0 1 2 3 ");
    for (const int fd : {ends[0], ends[1], high}) close(fd);
}

TEST_CASE("a process moved from another one ends the one it owned") {
    ChildProcess first(shell("exec sleep 1000"));
    const pid_t pid = first.pid();
    first = ChildProcess(shell("exit 0"));
    CHECK_FALSE(alive(pid));
    REQUIRE(first.wait(30s));
    CHECK(first.poll()->success());
}
