// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/cycle_lines.hpp"
#include "host/rt/periodic_tick.hpp"
#include "host/rt/thread.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace tandem::rt {

struct TickThread;

/// Cycles with equal options can share a thread.
struct SharedTickOptions {
    std::chrono::nanoseconds period, phase{0}; ///< ticks as of an aligned PeriodicTick
    ThreadOptions thread;
};

/// Returns whether cycles with these options can share a thread.
bool are_equal(const SharedTickOptions& a, const SharedTickOptions& b);

/// The cycles of one component or context, in a thread that runs the cycles of others with equal options one after the
/// other. There are at most as many such threads for equal options as processors. A cycle that waits for longer than its
/// share gets a separate thread at once, one that computes for longer than its share does after three such cycles, and
/// one that hangs keeps the thread, while the others get a new one.
class SharedTick : public std::enable_shared_from_this<SharedTick> {
  public:
    enum class Next : std::uint8_t { tick, rest };
    struct Work {
        /// Runs a cycle. Returns whether the next one runs at the next tick or only after wake().
        std::function<Next(const ArrivedTick& tick)> cycle;
        /// Is called as a Rehearsal (rehearsal.hpp) from time to time, and notes the lines that a cycle uses.
        std::function<void()> rehearse;
        std::string name;                                 ///< for the log
        std::function<void(const std::string& line)> log; ///< [any-thread]
    };

    /// Begins the cycles at the next tick, or, with `first` == rest, at once after wake(). Throws process::NotStarted.
    /// [any-thread]
    static std::shared_ptr<SharedTick> start(const SharedTickOptions& options, Work work, Next first);
    /// Use start().
    explicit SharedTick(Work work) : work_(std::move(work)) {}

    /// Runs a cycle at once if this tick rests. During a cycle: runs another one after it if it returns `rest`. [any-thread]
    void wake();
    /// Changes the options from the next cycle on. [any-thread]
    void change(const SharedTickOptions& options);
    /// Ends the cycles. Returns false if the current one has not returned after `timeout`. Called in the cycle itself, returns
    /// true, and the current cycle is the last one. [any-thread]
    bool leave(std::chrono::nanoseconds timeout);

  private:
    friend struct TickThread;
    friend class TickThreads;
    // First what each cycle needs. The members are guarded by the mutex of thread_, and thread_ by that of all threads.
    bool rests_ = false, woken_ = false, left_ = false, overran_ = false;
    std::int64_t took_ = 0;                         // duration of the last cycle
    int slow_cycles_ = 0;                           // in a row
    const Work work_;                               // the cycle is its first member
    CycleLines lines_;                              // used by the thread alone
    std::optional<SharedTickOptions> next_options_; // set in a cycle
    std::shared_ptr<TickThread> thread_;
};

/// Returns a token for one of the first 16 ticks of the process, which have separate threads; none: share a thread. The
/// place is free again when the token is released. [any-thread]
std::shared_ptr<void> take_separate_tick_thread();

} // namespace tandem::rt
