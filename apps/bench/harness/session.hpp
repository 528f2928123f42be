// SPDX-License-Identifier: Apache-2.0
// The interface of one side of a case: which side it is, when both sides are ready, when it has measured
// enough, and where its samples are stored.
#pragma once
#include "apps/bench/harness/case.hpp"
#include "apps/bench/harness/path_counts.hpp"
#include "apps/bench/harness/tick_record.hpp"
#include "apps/bench/harness/window_counts.hpp"
#include "apps/bench/machine/clock.hpp"

#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tandem::bench {

/// How long a case may take, and how many samples it may produce.
struct Budget {
    std::size_t warm_up = 10'000, samples = 50'000;
    double warm_up_seconds = 0.3, seconds = 1.5; ///< the first limit that is reached ends the measurement
    double window_seconds = 0.15; ///< the rate of a stream is measured over windows of this length
    int windows = 5;
    double timeout_seconds = 20; ///< after this time both sides are killed
    std::size_t tail_messages =
        5'000; ///< number of messages of a case of tails; the same number goes through the minimal ring
    int attempts = 4; ///< a case is repeated if other processes disturbed it
};

/// Memory that the driver and both sides share; zero at first. Room for the samples of the budget follows it.
struct Control {
    static constexpr std::size_t text_bytes = 400, listing_bytes = 32768;
    std::atomic<std::uint32_t> arrivals;       ///< calls of arrive_and_wait() of both sides
    std::atomic<std::uint32_t> stop_requested; ///< 0 or 1
    std::atomic<std::uint64_t> sample_count;
    char failure[2][text_bytes]; ///< of A and of B; empty on success
    bool has_tick_counts;
    TickCounts tick_counts;
    std::atomic<std::uint64_t> peer_switches; ///< see paired.hpp
    bool has_window_counts;
    WindowCounts window_counts;
    bool has_path_counts;
    PathCounts path_counts;
    char path_functions[listing_bytes]; ///< one line each
    double* samples() { return reinterpret_cast<double*>(this + 1); }
};

/// [one thread] The runner creates one for each side.
class Session {
  public:
    enum class Role { a, b };

    Session(const Case& bench_case, const Budget& budget, Role role, std::string name, Control& control,
            std::span<std::byte> memory)
        : case_(bench_case), budget_(budget), role_(role), name_(std::move(name)), control_(control),
          memory_(memory) {}

    const Case& bench_case() const { return case_; }
    const Budget& budget() const { return budget_; }
    bool is_side_a() const { return role_ == Role::a; }
    std::size_t bytes() const { return case_.bytes; } ///< of a message
    const std::string& name() const {
        return name_;
    } ///< equal on both sides, and different from that of every other case
    std::span<std::byte> memory() const { return memory_; } ///< shared by both sides: 64 MiB, zero at first

    /// Waits until both sides have called it the same number of times.
    void arrive_and_wait();

    /// The condition of the warm-up loop and of the measured loop: while (needs_more()) { ...;
    /// add_sample(duration, now); }. If there are several such loops (`parts`), each gets its share of the
    /// budget, and their samples add up.
    void begin_warm_up(std::size_t parts = 1) {
        begin(budget_.warm_up / parts, budget_.warm_up_seconds / static_cast<double>(parts), false);
    }
    void begin_measuring(std::size_t parts = 1) {
        begin(budget_.samples / parts, budget_.seconds / static_cast<double>(parts), true);
    }
    bool needs_more() const { return taken_ < wanted_ && last_ < end_; }
    /// Adds a sample; both in ticks. needs_more() checks `now`, so it does not read the clock again.
    void add_sample(std::uint64_t duration, std::uint64_t now) {
        if (keep_) control_.samples()[kept_++] = to_ns(duration) / case_.divisor;
        ++taken_;
        last_ = now;
    }
    /// Shows the samples to the driver.
    void end_measuring() { control_.sample_count.store(kept_, std::memory_order_release); }

    /// Adds one figure in the case's unit, for cases that do not time a loop.
    void add_result(double value);

    /// Sets how many of a case's ticks came a period late or more.
    void set_tick_counts(const TickCounts& counts) {
        control_.tick_counts = counts;
        control_.has_tick_counts = true;
    }

    /// Returns how often the side that does not measure has lost its core, as it last reported.
    std::atomic<std::uint64_t>& peer_switches() { return control_.peer_switches; }
    /// Sets how many windows of a paired case count.
    void set_window_counts(const WindowCounts& counts) {
        control_.window_counts = counts;
        control_.has_window_counts = true;
    }

    /// Sets the cost of a message and its functions, one line each. The last functions are left out if there is
    /// no room.
    void set_path(const PathCounts& counts, const std::vector<std::string>& functions);

    /// Called by the reader of a stream: asks the writer to stop.
    void request_stop() { control_.stop_requested.store(1, std::memory_order_release); }
    bool stop_requested() const { return control_.stop_requested.load(std::memory_order_relaxed) != 0; }

  private:
    void begin(std::size_t count, double seconds, bool keep);

    const Case& case_;
    const Budget& budget_;
    Role role_;
    std::string name_;
    Control& control_;
    std::span<std::byte> memory_;
    std::uint32_t barriers_ = 0;                    // calls of arrive_and_wait() of this side
    std::size_t taken_ = 0, wanted_ = 0, kept_ = 0; // samples of this loop; of all loops
    std::uint64_t last_ = 0, end_ = 0;              // ticks
    bool keep_ = false;                             // false: warm-up
};

} // namespace tandem::bench
