// SPDX-License-Identifier: Apache-2.0
// Tests the word on which the executor of an aperiodic component sleeps.
#include "host/opros/engine/execute/input_signal.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

using tandem::engine::InputSignal;
using namespace std::chrono_literals;

TEST_CASE("arrivals before the wait count as one") {
    InputSignal signal;
    CHECK_FALSE(signal.wait_for(0ns));
    signal.arrived();
    signal.arrived();
    signal.wait();
    CHECK_FALSE(signal.wait_for(1ms));
    signal.arrived();
    CHECK(signal.wait_for(0ns));
    CHECK_FALSE(signal.wait_for(0ns));
}

TEST_CASE("no arrival is lost while a wait begins, ends or times out") {
    InputSignal signal;
    constexpr int threads = 2, arrivals = 20000;
    std::array<std::atomic<int>, threads> sent{};
    std::array<std::thread, threads> senders;
    for (int i = 0; i < threads; ++i)
        senders[i] = std::thread([&, i] {
            for (int n = 1; n <= arrivals; ++n) {
                sent[i].store(n, std::memory_order_relaxed);
                signal.arrived();
                if (n % 16 == 0) std::this_thread::yield(); // let the receiver fall asleep
            }
        });
    // Hangs, until the test is ended, if the last arrival is lost.
    for (bool all = false, timed = false; !all; timed = !timed) {
        if (timed && !signal.wait_for(10us)) continue;
        if (!timed) signal.wait();
        all = true;
        for (const auto& each : sent) all = all && each.load(std::memory_order_relaxed) == arrivals;
    }
    for (auto& sender : senders) sender.join();
    CHECK(sent[0] == arrivals);
}

namespace {

/// A place to wait, as a source provides it. It refuses, or sleeps until wake() or value().
class LentWaiter : public ArrivalWaiter {
  public:
    Result wait(const DataPortListener&) override {
        std::unique_lock lock(mutex_);
        ++waits;
        if (refuses) return REFUSED;
        ends_.wait(lock, [this] { return woken_ || values_ > 0; });
        woken_ = false;
        if (values_ == 0) return WOKEN;
        --values_;
        return ARRIVED;
    }
    void wake(const DataPortListener&) override {
        const std::lock_guard lock(mutex_);
        ++wakes;
        woken_ = true;
        ends_.notify_one();
    }
    void value() {
        const std::lock_guard lock(mutex_);
        ++values_;
        ends_.notify_one();
    }
    std::atomic<bool> refuses{false};
    std::atomic<int> waits{0}, wakes{0};

  private:
    std::mutex mutex_;
    std::condition_variable ends_;
    bool woken_ = false;
    int values_ = 0;
};

/// An executor that counts its cycles.
class CountingExecutor {
  public:
    explicit CountingExecutor(InputSignal& signal)
        : signal_(signal), thread_([this] {
              for (signal_.wait(); !ends_; signal_.wait()) ++cycles;
          }) {}
    ~CountingExecutor() {
        ends_ = true;
        signal_.arrived();
        thread_.join();
    }
    std::atomic<int> cycles{0};

  private:
    InputSignal& signal_;
    std::atomic<bool> ends_{false};
    std::thread thread_;
};

bool becomes(const std::atomic<int>& count, int value) {
    for (int i = 0; i < 10000 && count != value; ++i) std::this_thread::sleep_for(1ms);
    return count == value;
}

} // namespace

TEST_CASE(
    "an executor sleeps in the waiter that it was lent, and wakes by its values and by other arrivals") {
    InputSignal signal;
    LentWaiter waiter;
    REQUIRE(signal.offerWaiter(&waiter));
    {
        CountingExecutor executor(signal);
        REQUIRE(becomes(waiter.waits, 1));
        waiter.value();
        CHECK(becomes(executor.cycles, 1));
        CHECK(waiter.wakes == 0);
        REQUIRE(becomes(waiter.waits, 2));
        signal.arrived();
        CHECK(becomes(executor.cycles, 2));
        CHECK(waiter.wakes == 1);
    }
    signal.withdrawWaiter(&waiter);
}

TEST_CASE("an executor whose waiter refuses sleeps on its own word, and asks again the next time") {
    InputSignal signal;
    LentWaiter waiter;
    waiter.refuses = true;
    REQUIRE(signal.offerWaiter(&waiter));
    CountingExecutor executor(signal);
    REQUIRE(becomes(waiter.waits, 1));
    std::this_thread::sleep_for(20ms);
    CHECK(waiter.waits == 1); // it is not asked again and again
    waiter.refuses = false;
    signal.arrived();
    CHECK(becomes(executor.cycles, 1));
    REQUIRE(becomes(waiter.waits, 2));
    waiter.value();
    CHECK(becomes(executor.cycles, 2));
    signal.withdrawWaiter(&waiter);
}

TEST_CASE("a waiter that was withdrawn is no longer in use, and arrivals are noticed without it") {
    InputSignal signal;
    CountingExecutor executor(signal);
    for (int i = 0; i < 100; ++i) {
        auto waiter = std::make_unique<LentWaiter>();
        LentWaiter second;
        REQUIRE(signal.offerWaiter(waiter.get()));
        CHECK_FALSE(signal.offerWaiter(&second)); // the executor can be in one place
        signal.arrived();
        REQUIRE(becomes(executor.cycles, 2 * i + 1));
        if (i % 2 == 0) REQUIRE(becomes(waiter->waits, 1));
        signal.withdrawWaiter(&second); // which it has not
        signal.withdrawWaiter(waiter.get());
        waiter.reset();
        signal.arrived();
        REQUIRE(becomes(executor.cycles, 2 * i + 2));
    }
}

TEST_CASE("no arrival is lost while a waiter is lent and withdrawn") {
    InputSignal signal;
    LentWaiter waiter;
    std::atomic<int> sent{0};
    std::atomic<bool> ends{false};
    std::thread sender([&] {
        for (int n = 1; n <= 4000; ++n) {
            sent.store(n, std::memory_order_relaxed);
            signal.arrived();
            if (n % 16 == 0) std::this_thread::yield();
        }
    });
    std::thread lender([&] {
        while (!ends) {
            signal.offerWaiter(&waiter);
            std::this_thread::yield();
            signal.withdrawWaiter(&waiter);
        }
    });
    // Hangs, until the test is ended, if the last arrival is lost.
    do signal.wait();
    while (sent.load(std::memory_order_relaxed) != 4000);
    ends = true;
    lender.join();
    sender.join();
    CHECK(sent == 4000);
}
