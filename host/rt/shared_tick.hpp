// SPDX-License-Identifier: Apache-2.0
#pragma once

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
/// share gets a separate thread at once, one that computes for longer than its share does after three times in a row, and
/// one that hangs keeps the thread, while the others get a new one.
class SharedTick : public std::enable_shared_from_this<SharedTick> {
  public:
    enum class Next : std::uint8_t { tick, rest };
    struct Work {
        std::string name; ///< for the log
        /// Runs a cycle whose tick was planned for this time of CLOCK_MONOTONIC, in ns. Returns whether the next one runs at
        /// the next tick or only after wake().
        std::function<Next(std::int64_t planned)> cycle;
        std::function<void(const std::string& line)> log; ///< [any-thread]
    };

    /// Begins the cycles at the next tick, or, with `first` == rest, at once after wake(). Throws process::NotStarted.
    /// [any-thread]
    static std::shared_ptr<SharedTick> start(const SharedTickOptions& options, Work work, Next first);
    /// Use start().
    explicit SharedTick(Work work) : work_(std::move(work)) {}

    /// Runs the next cycle at once if this tick rests. [any-thread]
    void wake();
    /// Changes the options from the next cycle on. [any-thread]
    void change(const SharedTickOptions& options);
    /// Ends the cycles. Returns false if the current one has not returned after `timeout`. Called in the cycle itself, returns
    /// true, and the current cycle is the last one. [any-thread]
    bool leave(std::chrono::nanoseconds timeout);

  private:
    friend struct TickThread;
    friend class TickThreads;
    const Work work_;
    std::shared_ptr<TickThread>
        thread_; // the members below are guarded by its mutex, itself by that of all threads
    std::optional<SharedTickOptions> next_options_; // set in a cycle
    bool rests_ = false, woken_ = false, left_ = false;
    int slow_cycles_ = 0; // in a row
};

/// Returns a token for one of the first 16 ticks of the process, which have separate threads; none: share a thread. The
/// place is free again when the token is released. [any-thread]
std::shared_ptr<void> take_separate_tick_thread();

} // namespace tandem::rt
