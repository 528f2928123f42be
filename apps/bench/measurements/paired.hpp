// SPDX-License-Identifier: Apache-2.0
// Two measurements in alternation, by the same two processes on the same two cores, in some hundred short windows. Each
// window gives one ratio. On a guest whose cores wander between physical ones a cache line takes 80 ns in one second and 300
// in the next: a floor that was measured a minute ago proves nothing.
#pragma once
#include "apps/bench/harness/summary.hpp"
#include "apps/bench/machine/core_switches.hpp"
#include "apps/bench/measurements/measurements.hpp"

#include <fmt/format.h>

namespace tandem::bench {

/// Says how many windows count. Throws std::runtime_error if too few are left for a median with quartiles.
inline void finish_windows(Session& session, const WindowCounts& counts) {
    session.set_window_counts(counts);
    if (counts.kept < 20)
        throw std::runtime_error(fmt::format("others had the core in {} of {} windows", counts.dropped,
                                             counts.dropped + counts.kept));
}

/// [side A] Collects the ratios of the windows in which neither side has lost its core.
class PairedWindows {
  public:
    explicit PairedWindows(Session& session) : session_(session) {}

    static std::size_t windows(const Budget& budget) { return budget.seconds < 1 ? 60 : 300; }

    void begin() { switches_ = all_switches(); }
    /// The times of both halves of the window, in ticks.
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
    std::uint64_t all_switches() const {
        return thread_switches() + session_.peer_switches().load(std::memory_order_acquire);
    }
    Session& session_;
    WindowCounts counts_;
    std::vector<double> floor_ns_;
    std::uint64_t switches_ = 0;
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

constexpr std::uint64_t round_trips_of_half = 200;

/// [side A] Half a window of round trips; its time in ticks.
template <class Endpoint>
std::uint64_t time_half_window(Endpoint& endpoint) {
    const auto exchange = [&](std::uint64_t sequence) {
        endpoint.send(sequence);
        require_sequence(endpoint.receive(), sequence);
    };
    exchange(1); // the first one finds its lines where the other half has left them
    const std::uint64_t begin = ticks();
    for (std::uint64_t sequence = 2; sequence < 2 + round_trips_of_half; ++sequence) exchange(sequence);
    const std::uint64_t time = ticks() - begin;
    exchange(stop_sequence);
    return time;
}

/// Round trips through Endpoint, in ratio to those through Floor.
template <class Endpoint, class Floor>
void measure_paired_round_trips(Session& session) {
    Floor floor(session);
    Endpoint endpoint(session);
    PairedWindows windows(session);
    session.arrive_and_wait();
    for (std::size_t i = 0; i < PairedWindows::windows(session.budget()); ++i) {
        if (!session.is_side_a()) {
            echo_half_window(session, floor);
            echo_half_window(session, endpoint);
            continue;
        }
        windows.begin();
        const std::uint64_t floor_time = time_half_window(floor);
        windows.end(time_half_window(endpoint), floor_time, 2 * round_trips_of_half);
    }
    session.arrive_and_wait(); // side A has its last answer before the memory of side B goes
    if (session.is_side_a()) windows.finish();
}

} // namespace tandem::bench
