// SPDX-License-Identifier: Apache-2.0
#include "tests/shm/fixture.hpp"

#include "shm/os/bounded_sleep.hpp"
#include "shm/os/futex.hpp"
#include "shm/os/futex_timeout_thread.hpp"

#include <csignal>
#include <sys/mman.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// Sleeps out a whole wait on a word that nobody wakes. In nanoseconds, what it took.
std::uint64_t sleep_out(std::chrono::nanoseconds bound) {
    std::atomic<std::uint32_t> word{1};
    const std::uint64_t start = now_ns();
    BoundedSleep sleep(bound);
    while (sleep.sleep_while(word, 1)) {
    }
    return now_ns() - start;
}

constexpr std::uint64_t coarse_tick = 10'000'000; // of the coarse clock, at 100 Hz

} // namespace

TEST_CASE("a sleep without its own timer ends at its bound and not before") {
    for (const auto bound : {15ms, 25ms, 60ms})
        CHECK(sleep_out(bound) + coarse_tick >= static_cast<std::uint64_t>(bound.count()) * 1'000'000);
}

TEST_CASE("a short sleep ends while a longer, earlier one continues") {
    std::atomic<std::uint32_t> word{1};
    std::atomic<bool> ended{false};
    std::thread sleeper([&] {
        while (word == 1) futex_wait(word, 1, deadline_after(1h));
        ended = true;
    });
    std::this_thread::sleep_for(20ms); // most likely it sleeps by now
    sleep_out(15ms);
    sleep_out(30ms);
    CHECK_FALSE(ended);
    word = 0;
    futex_wake(word, 1);
    sleeper.join();
    CHECK(ended);
}

TEST_CASE("sleepers beyond the slots of the timeout thread set their own timers, and all wake up") {
    std::vector<std::thread> sleepers;
    std::atomic<int> ended{0};
    for (int i = 0; i < 300; ++i)
        sleepers.emplace_back([&, i] {
            sleep_out(std::chrono::milliseconds(10 + i % 40));
            ++ended;
        });
    for (auto& sleeper : sleepers) sleeper.join();
    CHECK(ended == 300);
}

TEST_CASE("sleeps without a bound are ended by their memory range, and sleeps elsewhere continue") {
    struct {
        std::atomic<std::uint32_t> here[8]{}, elsewhere{0};
    } words;
    std::atomic<int> ended{0};
    std::atomic<bool> elsewhere_ended{false};
    std::vector<std::thread> sleepers;
    for (auto& word : words.here)
        sleepers.emplace_back([&] {
            while (!ended) futex_wait(word, 0, deadline_after(longest_wait));
            ++ended;
        });
    std::thread other([&] {
        futex_wait(words.elsewhere, 0, deadline_after(longest_wait));
        elsewhere_ended = true;
    });
    std::this_thread::sleep_for(20ms); // most likely they sleep by now
    ended = 1;
    // Repeated, because the words do not change: a thread may have read `ended` before and go to sleep
    // afterwards.
    CHECK(eventually([&] {
        FutexTimeoutThread::of_process().end_sleeps(std::as_bytes(std::span(words.here)));
        return ended == 9;
    }));
    for (auto& sleeper : sleepers) sleeper.join();
    CHECK_FALSE(elsewhere_ended);
    words.elsewhere = 1;
    futex_wake(words.elsewhere, 1);
    other.join();
}

TEST_CASE("all sleepers wake up while others come and go under the timeout thread") {
    std::vector<std::thread> sleepers;
    std::atomic<int> sleeps{0};
    for (int i = 0; i < 6; ++i)
        sleepers.emplace_back([&, i] {
            for (int turn = 0; turn < 15; ++turn, ++sleeps)
                sleep_out(std::chrono::microseconds(10'000 + 377 * ((i + turn) % 11)));
        });
    for (auto& sleeper : sleepers) sleeper.join();
    CHECK(sleeps == 90);
}

TEST_CASE("a sleep ends at its bound or when it is ended, even if the file behind its word is truncated "
          "meanwhile") {
    const bool at_its_bound = GENERATE(true, false);
    const int file = memfd_create("word", MFD_CLOEXEC);
    constexpr std::size_t bytes = sizeof(std::uint32_t); // the kernel maps a page
    REQUIRE(ftruncate(file, bytes) == 0);
    void* const page = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    REQUIRE(page != MAP_FAILED);
    auto& word = *new (page) std::atomic<std::uint32_t>(1);
    std::atomic<bool> ended{false};
    std::thread sleeper([&] {
        futex_wait(word, 1, deadline_after(at_its_bound ? 200ms : longest_wait));
        ended = true;
    });
    std::this_thread::sleep_for(20ms); // most likely it sleeps by now
    CHECK(ftruncate(file, 0) == 0);
    if (!at_its_bound)
        FutexTimeoutThread::of_process().end_sleeps({static_cast<const std::byte*>(page), bytes});
    CHECK(eventually([&] { return ended.load(); }));
    sleeper.join();
    munmap(page, bytes);
    close(file);
}

TEST_CASE("a thread that has blocked all signals sleeps no longer than its bound") {
    std::atomic<bool> ended{false};
    std::atomic<std::uint32_t> word{1};
    std::thread sleeper([&] {
        sleep_out(15ms); // the timeout thread knows this thread
        sigset_t all;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, nullptr);
        futex_wait(word, 1, deadline_after(30ms));
        ended = true;
    });
    CHECK(eventually([&] { return ended.load(); }, 5s));
    word = 0; // if it has failed
    futex_wake(word, 1);
    sleeper.join();
}

#ifndef __SANITIZE_THREAD__ // which lets no forked child start a thread
TEST_CASE("a forked child has its own timeout thread") {
    sleep_out(15ms); // starts the parent's
    const pid_t child = fork();
    if (child == 0) {
        sleep_out(15ms);
        _exit(7);
    }
    REQUIRE(child > 0);
    int status = 0;
    REQUIRE(eventually([&] { return waitpid(child, &status, WNOHANG) == child; }));
    CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 7));
}
#endif
