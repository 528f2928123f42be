// SPDX-License-Identifier: Apache-2.0
#include "host/rt/short_mutex.hpp"
#include "tests/support/membarrier.hpp"
#include "tests/support/skip.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <sys/resource.h>
#include <thread>
#include <vector>

using tandem::rt::ShortMutex;

TEST_CASE("threads that lock a short mutex exclude each other and none is left waiting") {
    ShortMutex mutex;
    long sum = 0; // without the mutex, a data race and lost additions
    constexpr long rounds = 50'000;
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&] {
            for (long n = 0; n < rounds; ++n) {
                const std::lock_guard lock(mutex);
                ++sum;
            }
        });
    for (auto& thread : threads) thread.join();
    CHECK(sum == 4 * rounds);
}

TEST_CASE("a thread that has a short mutex to itself and one that comes now and then exclude each other") {
    ShortMutex mutex;
    long sum = 0;
    std::atomic<bool> done{false};
    std::atomic<int> visits{0};
    std::thread visitor([&] {
        while (!done.load()) {
            {
                const std::lock_guard lock(mutex);
                sum += 1'000'000;
                visits.fetch_add(1);
            }
            std::this_thread::sleep_for(
                std::chrono::microseconds(200)); // the other one becomes the owner meanwhile
        }
    });
    long rounds = 0;
    for (; visits.load() < 300; ++rounds) { // the mutex loses its owner on the way
        const std::lock_guard lock(mutex);
        ++sum;
    }
    done.store(true);
    visitor.join();
    CHECK(sum == rounds + 1'000'000L * visits.load());
}

TEST_CASE("a thread that asks for a short mutex waits for its owner to leave") {
    ShortMutex mutex;
    for (int i = 0; i < 100; ++i) {
        const std::lock_guard lock(mutex);
    }
    std::atomic<bool> owner_is_inside{true};
    mutex.lock();
    auto asked = std::async(std::launch::async, [&] {
        const std::lock_guard lock(mutex);
        return owner_is_inside.load();
    });
    CHECK(asked.wait_for(std::chrono::milliseconds(100)) == std::future_status::timeout);
    owner_is_inside.store(false);
    mutex.unlock();
    CHECK_FALSE(asked.get());
    const std::lock_guard lock(mutex); // it is free, for the owner, too
}

TEST_CASE("a thread that waits for a short mutex sleeps") {
    ShortMutex mutex;
    mutex.lock();
    std::promise<double> cpu_seconds;
    std::thread waiting([&] {
        const std::lock_guard lock(mutex);
        rusage usage{};
        getrusage(RUSAGE_THREAD, &usage);
        cpu_seconds.set_value(1e-6 * double(usage.ru_utime.tv_usec) + double(usage.ru_utime.tv_sec));
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    mutex.unlock();
    CHECK(cpu_seconds.get_future().get() < 0.1); // it would be 0.3 if it polled
    waiting.join();
}

TEST_CASE("a short mutex is locked without waiting by its owner only") {
    ShortMutex mutex;
    CHECK_FALSE(mutex.lock_if_owner());
    for (int i = 0; i < 100; ++i) const std::lock_guard lock(mutex);
    const bool owned = mutex.lock_if_owner();
    CHECK(owned == tandem::test::mutexes_have_owners());
    CHECK_FALSE(std::async(std::launch::async, [&] { return mutex.lock_if_owner(); }).get());
    if (owned) mutex.unlock();
    std::async(std::launch::async, [&] {
        const std::lock_guard lock(mutex);
    }).get(); // nobody has it any more
}

TEST_CASE("a short mutex is tried by any thread without waiting") {
    ShortMutex mutex;
    const auto others_try = [&] {
        return std::async(std::launch::async,
                          [&] {
                              const std::unique_lock lock(mutex, std::try_to_lock);
                              return lock.owns_lock();
                          })
            .get();
    };
    const bool owned = GENERATE(false, true);
    for (int i = 0; owned && i < 100; ++i) {
        const std::lock_guard lock(mutex);
    }
    CHECK(others_try());
    mutex.lock();
    CHECK_FALSE(others_try());
    mutex.unlock();
    CHECK(others_try());
    const std::unique_lock lock(mutex, std::try_to_lock);
    CHECK(lock.owns_lock());
    CHECK_FALSE(others_try());
}

TEST_CASE("threads that try a short mutex and its owner exclude each other") {
    ShortMutex mutex;
    long sum = 0;
    std::atomic<bool> done{false};
    std::atomic<int> visits{0};
    std::thread visitor([&] {
        while (!done.load()) {
            if (const std::unique_lock lock(mutex, std::try_to_lock); lock) {
                sum += 1'000'000;
                visits.fetch_add(1);
            }
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
    });
    long rounds = 0;
    for (; visits.load() < 200; ++rounds) {
        const std::lock_guard lock(mutex);
        ++sum;
    }
    done.store(true);
    visitor.join();
    CHECK(sum == rounds + 1'000'000L * visits.load());
}

TEST_CASE("a short mutex keeps its owner while others come now and then, and loses it when one comes often") {
    ShortMutex mutex;
    const auto is_owned = [&] {
        if (!mutex.lock_if_owner()) return false;
        mutex.unlock();
        return true;
    };
    const auto visit = [&](int times) {
        std::thread([&] {
            for (int i = 0; i < times; ++i) const std::lock_guard lock(mutex);
        }).join();
    };
    for (int i = 0; i < 100; ++i) const std::lock_guard lock(mutex);
    if (!tandem::test::mutexes_have_owners()) TANDEM_SKIP("membarrier(2) is not permitted");
    for (int restart = 0; restart < 3; ++restart) {
        visit(40);
        REQUIRE(is_owned());
        std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // they are counted for a second
    }
    for (int tries = 0; tries < 100 && is_owned(); ++tries) visit(1000);
    CHECK_FALSE(is_owned());
}
