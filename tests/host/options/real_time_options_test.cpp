// SPDX-License-Identifier: Apache-2.0
#include "host/options/real_time_options.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <functional>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using tandem::options::apply;
using tandem::options::RealTimeOptions;

namespace {

/// Runs body() in a separate process, because the effects of apply() last as long as the process. Returns the result of body().
bool in_child_process(const std::function<bool()>& body) {
    const pid_t child = fork();
    if (child == 0) _exit(body() ? 0 : 1);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool in_new_thread(const std::function<bool()>& check) {
    bool result = false;
    std::thread([&] { result = check(); }).join();
    return result;
}

} // namespace

TEST_CASE("threads started after the options are applied have a timer slack of one nanosecond") {
    CHECK(in_child_process([] {
        return apply({}).empty() && in_new_thread([] { return prctl(PR_GET_TIMERSLACK, 0, 0, 0, 0) == 1; });
    }));
}

TEST_CASE("in wait mode same-core all threads of the process stay on its processor") {
    CHECK(in_child_process([] {
        RealTimeOptions options;
        options.cpu = sched_getcpu();
        options.wait_mode = "same-core";
        return apply(options).empty() && in_new_thread([&] {
                   cpu_set_t set;
                   return sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) == 1 &&
                          CPU_ISSET(static_cast<std::size_t>(options.cpu), &set);
               });
    }));
}

TEST_CASE("other wait modes leave threads on all processors and are passed on to plugins") {
    CHECK(in_child_process([] {
        cpu_set_t before, after;
        sched_getaffinity(0, sizeof before, &before);
        RealTimeOptions options;
        options.cpu = sched_getcpu();
        options.wait_mode = "spin";
        const bool accepted = apply(options).empty();
        sched_getaffinity(0, sizeof after, &after);
        return accepted && CPU_EQUAL(&before, &after) && std::string(getenv("TANDEM_WAIT_MODE")) == "spin";
    }));
}

TEST_CASE("same-core without a processor is refused") {
    RealTimeOptions options;
    options.wait_mode = "same-core";
    CHECK_THROWS_WITH(apply(options),
                      "--wait-mode same-core needs --cpu N, the same processor for both hosts");
}

TEST_CASE("each option that the kernel refuses gives one line and no error") {
    CHECK(in_child_process([] {
        if (geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0)) return false;
        RealTimeOptions options;
        options.cpu = 100000;
        options.wait_mode = "same-core";
        options.low_latency_idle = true;
        const auto notices = apply(options);
        if (notices.size() != 2) return false;
        for (const auto& notice : notices)
            if (notice.find('\n') != std::string::npos) return false;
        return notices[0].find("processor 100000") != std::string::npos &&
               notices[1].find("/dev/cpu_dma_latency") != std::string::npos;
    }));
}
