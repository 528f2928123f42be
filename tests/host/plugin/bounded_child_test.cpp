// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/bounded_child.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <sys/wait.h>
#include <system_error>
#include <thread>

using namespace std::chrono_literals;
using tandem::plugin::run_bounded;

namespace {
tandem::plugin::ChildEnd shell(const std::string& script, std::chrono::milliseconds bound = 30s) {
    return run_bounded({"/bin/sh", "-c", script}, bound);
}
long descriptors() {
    const auto all = std::filesystem::directory_iterator("/proc/self/fd");
    return std::distance(begin(all), end(all));
}
bool gone(const std::string& pid) {
    for (int i = 0; i < 3000; ++i) { // init may take a moment to reap it
        if (kill(std::stoi(pid), 0) != 0) return true;
        std::this_thread::sleep_for(10ms);
    }
    return false;
}
} // namespace

TEST_CASE("a bounded child's report and the end of its standard error come back with its status") {
    const auto end =
        shell("echo report >&3; echo output; head -c 9000 /dev/zero | tr '\\0' x >&2; echo last >&2; exit 5");
    CHECK(end.report == "report\n");
    CHECK(end.errors.size() == 4096);
    CHECK(end.errors.substr(4091) == "last\n");
    REQUIRE(WIFEXITED(end.status));
    CHECK(WEXITSTATUS(end.status) == 5);
    CHECK_FALSE(end.timed_out);
    CHECK(WTERMSIG(shell("kill -SEGV $$").status) == SIGSEGV);
}

TEST_CASE("a bounded child that does not end is killed and so are its own children") {
    const auto end = shell("sleep 1000 & echo $! >&3; wait", 1s);
    CHECK(end.timed_out);
    CHECK(gone(end.report));
}

TEST_CASE("a grandchild that holds the pipes open does not hold up its grandparent and is ended") {
    const auto end = shell("sleep 1000 & echo $! >&3");
    CHECK_FALSE(end.timed_out);
    CHECK(gone(end.report));
}

TEST_CASE("a program that cannot be started is an error that names it") {
    CHECK_THROWS_WITH(run_bounded({"/no/such/program"}, 1s), Catch::Contains("/no/such/program"));
    CHECK_THROWS_AS(run_bounded({"/no/such/program"}, 1s), std::system_error);
}

TEST_CASE("bounded children leave no descriptors behind") {
    shell("exit 0");
    const auto before = descriptors();
    for (int i = 0; i < 20; ++i) shell("echo x >&3");
    CHECK_THROWS(run_bounded({"/no/such/program"}, 1s));
    shell("sleep 1000", 10ms);
    CHECK(descriptors() == before);
}
