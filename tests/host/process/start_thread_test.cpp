// SPDX-License-Identifier: Apache-2.0
// Threads and processes at the limit of the user.
#include "host/process/bounded_call.hpp"
#include "host/process/child_process.hpp"
#include "host/process/exit/exit_timer.hpp"
#include "host/process/start_thread.hpp"
#include "tests/support/thread_limit.hpp"

#include <catch2/catch.hpp>
#include <cerrno>
#include <string>
#include <sys/resource.h>
#include <thread>

using namespace std::chrono_literals;
using namespace tandem::process;
using tandem::test::holds_at_thread_limit;

namespace {

constexpr rlim_t ample = rlim_t{1} << 46; // bytes of address space; more than any process uses

bool names_the_limit(const std::string& line, const std::string& start) {
    return line.starts_with(start) && line.find("Resource temporarily unavailable: ") != std::string::npos &&
           line.find("(ulimit -u); end some, or raise it") != std::string::npos &&
           line.find('\n') == std::string::npos;
}

} // namespace

TEST_CASE("a thread that cannot be started is reported in one line with the limit and the remedy") {
    CHECK(holds_at_thread_limit([](const auto& reach_limit) {
        reach_limit();
        try {
            start_thread([] {}).join();
        } catch (const NotStarted& error) {
            return names_the_limit(error.what(), "no thread can be started: ");
        }
        return false;
    }));
}

TEST_CASE("a limit that is not reached is not blamed for a thread that cannot be started") {
    CHECK(holds_at_thread_limit([](const auto& reach_limit) {
        const rlimit addresses{ample, ample};
        if (setrlimit(RLIMIT_AS, &addresses) != 0) return false;
        reach_limit();
        const std::string line = NotStarted(EAGAIN, "no thread").what();
        return names_the_limit(line, "no thread: ") && line.find("ulimit -v") == std::string::npos;
    }));
}

TEST_CASE("limits are listed as candidates when none of them is reached") {
    CHECK(holds_at_thread_limit([](const auto&) {
        const rlimit addresses{ample, ample};
        rlimit threads{};
        if (getrlimit(RLIMIT_NPROC, &threads) != 0) return false;
        threads.rlim_cur = threads.rlim_max == RLIM_INFINITY ? 1'000'000 : threads.rlim_max;
        if (setrlimit(RLIMIT_NPROC, &threads) != 0 || setrlimit(RLIMIT_AS, &addresses) != 0) return false;
        const std::string line = NotStarted(EAGAIN, "no thread").what();
        return line.find("one of these limits is reached: ") != std::string::npos &&
               line.find("(ulimit -v); or user ") != std::string::npos &&
               line.find("kernel.threads-max") != std::string::npos;
    }));
}

TEST_CASE("a process that cannot be started is reported in one line with the limit and the remedy") {
    CHECK(holds_at_thread_limit([](const auto& reach_limit) {
        reach_limit();
        try {
            ChildProcess child({"/bin/true"}, {});
        } catch (const std::system_error& error) {
            return names_the_limit(error.what(), "/bin/true cannot be started: ");
        }
        return false;
    }));
}

TEST_CASE("an exit timer ends a process that can start no thread") {
    CHECK(holds_at_thread_limit([](const auto& reach_limit) {
        reach_limit();
        const ExitTimer timer(20ms, "", 0);
        std::this_thread::sleep_for(20s); // ended by the timer
        return false;
    }));
}

TEST_CASE("an exit timer that no longer exists ends nothing") {
    CHECK(holds_at_thread_limit([](const auto&) {
        { const ExitTimer timer(20ms, "", 1); }
        std::this_thread::sleep_for(100ms);
        return true;
    }));
}

TEST_CASE("a call of the end of a host that does not return and has no thread ends the process with 1") {
    CHECK_FALSE(holds_at_thread_limit([](const auto& reach_limit) {
        reach_limit();
        return BoundedCall::returns_within(
            20ms, [] { std::this_thread::sleep_for(20s); }, {}, BoundedCall::WithoutThread::exit);
    }));
}

TEST_CASE("a bounded call without a free thread runs in the calling thread") {
    CHECK(holds_at_thread_limit([](const auto& reach_limit) {
        reach_limit();
        bool has_run = false;
        return BoundedCall::returns_within(30s, [&] { has_run = true; }) && has_run;
    }));
}
