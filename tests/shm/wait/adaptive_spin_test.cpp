// SPDX-License-Identifier: Apache-2.0
#include "shm/wait/adaptive_spin.hpp"

#include "shm/os/tick_length.hpp"
#include "shm/wait/basic_doorbell.hpp"

#include <catch2/catch.hpp>

using tandem::shm::AdaptiveSpin;
using tandem::shm::TickLength;
using namespace std::chrono_literals;

namespace {

/// A clock that advances by 0.1 us with each reading, and sleeps that end with a ring after a time that the
/// test chooses.
struct ScriptedAtomics : tandem::shm::RealAtomics {
    static inline std::uint64_t time_ns = 0, sleep_ns = 0, began_to_sleep_ns = 0;
    static inline tandem::shm::BasicDoorbell<ScriptedAtomics>* bell = nullptr;
    static constexpr unsigned rounds_per_clock = 1;

    static std::uint64_t now() { return time_ns += 100; }
    static std::uint64_t ticks() { return 3 * time_ns; }

    struct BoundedSleep {
        explicit BoundedSleep(std::chrono::nanoseconds) {}
        bool sleep_while(std::atomic<std::uint32_t>&, std::uint32_t) {
            began_to_sleep_ns = time_ns;
            time_ns += sleep_ns;
            bell->ring(0);
            return true;
        }
    };
};

/// How long an owner polls before it sleeps.
std::uint64_t polled_ns(std::uint64_t sleep_ns) {
    const std::uint64_t start = ScriptedAtomics::time_ns;
    ScriptedAtomics::sleep_ns = sleep_ns;
    CHECK(ScriptedAtomics::bell->wait(1h).test(0));
    return ScriptedAtomics::began_to_sleep_ns - start;
}

} // namespace

TEST_CASE("the spin time shrinks while waits are long and is restored by a short wait") {
    constexpr std::uint64_t full = 50'000;
    AdaptiveSpin spin;
    CHECK(spin.limit_ns(full) == full);
    spin.learn(full, 10 * full);
    CHECK(spin.limit_ns(full) == full / 2);
    for (int i = 0; i < 100; ++i) spin.learn(full, 1'000'000'000);
    CHECK(spin.limit_ns(full) == 2'000);
    spin.learn(full, 3 * full); // neither short nor far beyond
    CHECK(spin.limit_ns(full) == 2'000);
    spin.learn(full, full + full / 2);
    CHECK(spin.limit_ns(full) == full);
}

TEST_CASE("a spin time below the minimum is not changed") {
    AdaptiveSpin spin;
    for (int i = 0; i < 100; ++i) spin.learn(500, 1'000'000);
    CHECK(spin.limit_ns(500) == 500);
    CHECK(spin.limit_ns(0) == 0);
}

TEST_CASE("the tick length is computed from an interval that the clock has also measured") {
    const TickLength third(2'000, 6'000);  // a counter of 3 GHz, beside a short time of polling
    CHECK(third.ns(90'000) / 1'000 == 29); // rounded down
    CHECK(third.ns(std::uint64_t{24} * 3600 * 3'000'000'000) / 1'000'000'000 ==
          24 * 3600 - 1); // rounded down
    CHECK(TickLength(2'000, 2'000).ns(1'024'000) == 1'024'000);
    CHECK(TickLength(64'000, 1'000).ns(1'024'000) == 65'536'000);
}

TEST_CASE("a counter that stands still or goes back breaks no measurement") {
    CHECK(TickLength(2'000, 0).ns(0) == 0);
    CHECK(TickLength(2'000, ~std::uint64_t{0}).ns(1'000'000) == 0);
    CHECK(TickLength(0, 6'000).ns(~std::uint64_t{0}) == 0);
}

TEST_CASE("an owner polls briefly after a long sleep, and for the full time again after a short one") {
    tandem::shm::layout::BasicDoorbellWords<ScriptedAtomics> words{};
    tandem::shm::BasicDoorbell<ScriptedAtomics> bell(words);
    ScriptedAtomics::bell = &bell;
    CHECK(polled_ns(1'000'000'000) >= 50'000);
    for (int i = 0; i < 20; ++i) polled_ns(1'000'000'000);
    CHECK(polled_ns(30'000) < 3'000); // which it would have caught by polling
    CHECK(polled_ns(1'000'000'000) >= 50'000);
    CHECK(polled_ns(150'000) < 40'000); // halved; a sleep of three times the full time changes nothing
    CHECK(polled_ns(1'000'000'000) < 40'000);
}
