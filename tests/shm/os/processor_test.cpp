// SPDX-License-Identifier: Apache-2.0
#include "shm/os/processor.hpp"

#include "shm/os/recent_clock.hpp"
#include "shm/os/tick_length.hpp"

#include <array>
#include <catch2/catch.hpp>

using namespace tandem::shm;

namespace {

/// The counter of many arm64 boards.
struct SlowProcessor : PortableProcessor {
    static constexpr std::uint64_t hz = 19'200'000;
    static inline std::uint64_t ticks = 1'000'000'000'000;

    static std::uint64_t counter() { return ticks; }
    static constexpr std::uint64_t min_counter_hz() { return hz; }
    static void pass(std::uint64_t ns) { ticks += ns * hz / 1'000'000'000; }
};

/// Returns a moment after those that were read before.
std::uint64_t later_than(std::uint64_t ns) {
    while (now_ns() == ns) {
    }
    return now_ns();
}

template <class P>
bool copies_two_words() {
    const std::array<std::uint64_t, 2> words{0x0123456789abcdef, 0xfedcba9876543210};
    std::array<std::uint64_t, 2> shared{}, copy{};
    P::store_two_words(shared.data(), words.data());
    P::load_two_words(copy.data(), shared.data());
    return shared == words && copy == words;
}

} // namespace

TEST_CASE("the recent clock is exact to its limit with a counter of 19 MHz") {
    using Clock = BasicRecentClock<SlowProcessor>;
    Clock clock;
    const std::uint64_t first = clock.now_ns();
    const std::uint64_t later = later_than(first);
    SlowProcessor::pass(20'000);
    CHECK(clock.now_ns() == first);
    SlowProcessor::pass(Clock::max_age_ns - 20'000);
    CHECK(clock.now_ns() >= later);
}

TEST_CASE("a pause in ticks lasts as long with a counter of 19 MHz") {
    CHECK(ticks_within<SlowProcessor>(500'000'000) == SlowProcessor::hz / 2);
    CHECK(ticks_within<SlowProcessor>(0) == 0);
    CHECK(ticks_within(1'000'000'000) == Processor::min_counter_hz());
}

TEST_CASE("the length of a short wait is known with a counter of 19 MHz") {
    const TickLength tick(20'000, 384);
    CHECK(tick.ns(384) == Approx(20'000).margin(1'000));
    CHECK(tick.ns(2 * SlowProcessor::hz) == Approx(2e9).epsilon(0.001));
    CHECK(tick.ns(86'400 * SlowProcessor::hz) == Approx(86'400e9).epsilon(0.001)); // a day
}

TEST_CASE("each form of a processor copies two words without tearing them") {
    CHECK(copies_two_words<PortableProcessor>());
    CHECK(copies_two_words<Processor>());
}
