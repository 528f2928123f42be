// SPDX-License-Identifier: Apache-2.0
#include "host/rt/thread.hpp"

#include <catch2/catch.hpp>
#include <pthread.h>
#include <sys/prctl.h>
#include <thread>

using tandem::rt::configure_this_thread;

TEST_CASE("a thread that is set up has its name and a timer slack of one nanosecond") {
    std::thread([] {
        CHECK(configure_this_thread({"a name longer than fifteen", 0, -1}).empty());
        char name[16] = "";
        pthread_getname_np(pthread_self(), name, sizeof name);
        CHECK(std::string(name) == "a name longer t");
        CHECK(prctl(PR_GET_TIMERSLACK, 0, 0, 0, 0) == 1);
    }).join();
}

TEST_CASE("a processor that does not exist causes a notice of one line, and the thread keeps running") {
    std::thread([] {
        const auto notices = configure_this_thread({"pinned", 0, 100000});
        REQUIRE(notices.size() == 1);
        CHECK(notices[0].find("100000") != std::string::npos);
        CHECK(notices[0].find('\n') == std::string::npos);
    }).join();
}

TEST_CASE("a real-time priority is granted or refused with a notice, never an error") {
    std::thread([] { CHECK(configure_this_thread({"fast", 10, -1}).size() <= 1); }).join();
}
