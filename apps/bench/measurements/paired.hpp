// SPDX-License-Identifier: Apache-2.0
// Two measurements in alternation, by the same two processes on the same two cores, in some hundred short
// windows. Each window gives one ratio. On a guest whose cores move between physical ones, a cache line takes
// 80 ns in one second and 300 in the next, so a floor that was measured a minute ago proves nothing.
#pragma once
#include "apps/bench/harness/summary.hpp"
#include "apps/bench/machine/core_switches.hpp"
#include "apps/bench/measurements/measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sys/mman.h>
#include <vector>

namespace tandem::bench {

/// Reports how many windows count. Throws std::runtime_error if too few are left for a median with quartiles.
inline void finish_windows(Session& session, const WindowCounts& counts) {
    session.set_window_counts(counts);
    if (counts.kept < 20)
        throw std::runtime_error(fmt::format("others had the core in {} of {} windows", counts.dropped,
                                             counts.dropped + counts.kept));
}

/// [the side that measures] Collects the ratios of the windows in which neither side has lost its core.
class PairedWindows {
  public:
    explicit PairedWindows(Session& session) : session_(session) {}

    static std::size_t windows(const Budget& budget) { return budget.seconds < 1 ? 60 : 300; }

    void begin() { switches_ = all_switches(); }
    /// Adds the times of both halves of the window, in ticks.
    void end(std::uint64_t measured, std::uint64_t floor, std::size_t floor_messages) {
        const bool undisturbed = all_switches() == switches_;
        ++(undisturbed ? counts_.kept : counts_.dropped);
        if (!undisturbed) return;
        floor_ns_.push_back(to_ns(floor) / static_cast<double>(floor_messages));
        session_.add_result(static_cast<double>(measured) / static_cast<double>(floor));
    }
    void finish() {
        counts_.floor_ns = median(floor_ns_);
        finish_windows(session_, counts_);
    }

  private:
    /// No window is left out if both sides run on one core: there, each wake-up takes the core from the other
    /// side.
    std::uint64_t all_switches() const {
        if (session_.bench_case().placement == Placement::same_core) return 0;
        return thread_switches() + session_.peer_switches().load(std::memory_order_acquire);
    }
    Session& session_;
    WindowCounts counts_;
    std::vector<double> floor_ns_;
    std::uint64_t switches_ = 0;
};

/// [one thread] Holds memory: otherwise the kernel would give the pages that it got back last to the next
/// place.
class HeldMemory {
  public:
    HeldMemory() = default;
    ~HeldMemory() {
        for (void* const block : blocks_) munmap(block, block_bytes);
    }
    HeldMemory(const HeldMemory&) = delete;
    HeldMemory& operator=(const HeldMemory&) = delete;
    /// Does nothing without memory.
    void add() {
        void* const block = mmap(nullptr, block_bytes, PROT_READ | PROT_WRITE,
                                 MAP_PRIVATE | MAP_ANONYMOUS | MAP_POPULATE, -1, 0);
        if (block != MAP_FAILED) blocks_.push_back(block);
    }

  private:
    static constexpr std::size_t block_bytes = 4 * mebibyte; // more than a link takes
    std::vector<void*> blocks_;
};

/// [side B] Half a window: sends every message back, up to and including the stop message.
template <class Endpoint>
void echo_half_window(Session& session, Endpoint& endpoint) {
    for (;;) {
        const std::uint64_t sequence = endpoint.receive();
        if (sequence == stop_sequence)
            session.peer_switches().store(thread_switches(), std::memory_order_release);
        endpoint.send(sequence);
        if (sequence == stop_sequence) return;
    }
}

/// Few where each message wakes a thread.
inline std::uint64_t round_trips_of_half(Wake wake) { return wake == Wake::blocking ? 60 : 200; }

/// How the round trips of half a window are summed up: by the time of them all, or by the median of one times
/// their number. The median ignores what affects only a few of them, but needs a reading of the clock for each.
enum class HalfTime { sum, median };

/// [side A] Measures half a window of round trips; returns its time in ticks.
template <HalfTime half_time, class Endpoint>
std::uint64_t time_half_window(Endpoint& endpoint, std::uint64_t round_trips) {
    const auto exchange = [&](std::uint64_t sequence) {
        endpoint.send(sequence);
        require_sequence(endpoint.receive(), sequence);
    };
    exchange(1); // the first one finds its lines where the other half has left them
    std::vector<double> times;
    if constexpr (half_time == HalfTime::median) times.reserve(round_trips);
    const std::uint64_t begin = ticks();
    for (std::uint64_t sequence = 2; sequence < 2 + round_trips; ++sequence) {
        if constexpr (half_time == HalfTime::sum) {
            exchange(sequence);
        } else {
            const std::uint64_t sent = ticks();
            exchange(sequence);
            times.push_back(static_cast<double>(ticks() - sent));
        }
    }
    const std::uint64_t sum = ticks() - begin;
    exchange(stop_sequence);
    if constexpr (half_time == HalfTime::sum) return sum;
    return static_cast<std::uint64_t>(median(std::move(times)) * static_cast<double>(round_trips));
}

/// [both sides] Measures the windows of a case in several places of the memory, one after the other, each as
/// window(floor, endpoint). In each place both are created again, as Floor(session, place) and
/// Endpoint(session).
template <class Endpoint, class Floor, std::size_t places, class Window>
void for_each_window(Session& session, Window&& window) {
    HeldMemory memory;
    for (std::size_t place = 0; place < places; ++place) {
        if (place != 0) memory.add();
        session.arrive_and_wait(); // both sides have left the link that is created again
        Floor floor(session, place);
        Endpoint endpoint(session);
        session.arrive_and_wait();
        for (std::size_t i = 0; i < PairedWindows::windows(session.budget()) / places; ++i)
            window(floor, endpoint);
        session
            .arrive_and_wait(); // each side has the last message of the other before that side's memory is released
    }
}

/// Measures the ratio of round trips through Endpoint to those through Floor(session, place), in 30 places of
/// the memory: the ratio differs by a third between places, so the result of a single place would depend on
/// chance. If each message wakes a thread, that does not matter.
template <class Endpoint, class Floor, std::size_t places = 30, HalfTime half_time = HalfTime::sum>
void measure_paired_round_trips(Session& session) {
    const std::uint64_t round_trips = round_trips_of_half(session.bench_case().wake);
    PairedWindows windows(session);
    for_each_window<Endpoint, Floor, places>(session, [&](Floor& floor, Endpoint& endpoint) {
        if (!session.is_side_a()) {
            echo_half_window(session, floor);
            echo_half_window(session, endpoint);
            return;
        }
        windows.begin();
        const std::uint64_t floor_time = time_half_window<half_time>(floor, round_trips);
        windows.end(time_half_window<half_time>(endpoint, round_trips), floor_time, 2 * round_trips);
    });
    if (session.is_side_a()) windows.finish();
}

/// [both sides] Sends `messages` messages through Endpoint without a pause; the first tenth does not count.
/// Returns side B's time for the others, in ticks.
template <class Endpoint>
std::uint64_t time_half_stream(Session& session, Endpoint& endpoint, std::uint64_t messages) {
    std::uint64_t begin = 0;
    for (std::uint64_t sequence = 1; sequence <= messages; ++sequence) {
        if (session.is_side_a())
            endpoint.send(sequence);
        else
            require_sequence(endpoint.receive(), sequence);
        if (sequence == messages / 10 + 1) begin = ticks();
    }
    const std::uint64_t time = ticks() - begin;
    if (session.is_side_a()) session.peer_switches().store(thread_switches(), std::memory_order_release);
    session.arrive_and_wait(); // both paths are empty
    return time;
}

/// Measures the ratio of the time of a message in a stream through Endpoint to that through Floor(session,
/// place). For short messages the ratio differs by a third between places.
template <class Endpoint, class Floor, std::size_t places>
void measure_paired_streams(Session& session) {
    constexpr std::size_t bytes_of_half = 32 * mebibyte;
    const std::uint64_t messages = std::clamp<std::uint64_t>(bytes_of_half / session.bytes(), 20, 100'000);
    PairedWindows windows(session);
    for_each_window<Endpoint, Floor, places>(session, [&](Floor& floor, Endpoint& endpoint) {
        windows.begin();
        const std::uint64_t floor_time = time_half_stream(session, floor, messages);
        const std::uint64_t time = time_half_stream(session, endpoint, messages);
        if (!session.is_side_a()) windows.end(time, floor_time, messages - messages / 10 - 1);
    });
    if (!session.is_side_a()) windows.finish();
}

} // namespace tandem::bench
