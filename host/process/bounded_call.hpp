// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

namespace tandem::process {

/// Runs code that may never return (a component's callback or destructor) in a separate thread.
class BoundedCall {
  public:
    /// What limits `work` if no thread is free and it runs in the calling thread: nothing, or the process exits with code 1
    /// after `timeout`. Only the end of a host may request the latter.
    enum class WithoutThread { no_limit, exit };

    /// Runs `work`, waits at most `timeout` (from the start of its thread, or from 1 s after this call), and rethrows its
    /// exception. Returns false if `work` still runs; its thread is then detached, and the objects that `work` refers to must
    /// live as long as the process. Calls `on_slow` in the calling thread after 2 s, 4 s, 8 s, ... [any-thread]
    static bool returns_within(std::chrono::nanoseconds timeout, std::function<void()> work,
                               const std::function<void(std::chrono::seconds)>& on_slow = {},
                               WithoutThread without_thread = WithoutThread::no_limit);

    /// The calls work(0) ... work(count - 1).
    struct Series {
        std::size_t count;
        std::function<void(std::size_t i)> work;
        std::function<std::chrono::nanoseconds(std::size_t i)> timeout;
        /// Call i still runs. Returns whether the series continues. In the calling thread.
        std::function<bool(std::size_t i)> on_timeout;
        std::function<void(std::size_t i, std::chrono::seconds time)> on_slow{};
        WithoutThread without_thread = WithoutThread::no_limit;
    };
    /// Runs one call after the other as returns_within() does. Calls that return share a thread, because a change of threads for
    /// each of a thousand components takes seconds on a loaded machine. An exception ends the series. [any-thread]
    static void run_series(const Series& series);

    /// Returns whether any call of this process has not returned yet. Static objects must not be destroyed while a call is
    /// running: end such a process with exit_process(). [any-thread]
    static bool any_running();
};

} // namespace tandem::process
