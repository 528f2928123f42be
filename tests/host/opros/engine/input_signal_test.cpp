// SPDX-License-Identifier: Apache-2.0
// The word on which the executor of an aperiodic component sleeps.
#include "host/opros/engine/execute/input_signal.hpp"

#include <catch2/catch.hpp>

#include <array>
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

TEST_CASE("no arrival is lost beside a wait that begins, ends or runs out") {
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
