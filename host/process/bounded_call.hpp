// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>

namespace tandem::process {

/// Runs code that may never return (a component's callback or destructor) in a thread of its own.
class BoundedCall {
  public:
    /// Runs `work` and waits at most `timeout` for its end. The time counts from when its thread has got a processor, or
    /// from 1 s later. An exception that it throws in time is rethrown here. False: `work` still runs; its thread is
    /// detached, so what `work` refers to must stay alive for the rest of the process. `on_slow` is called here when
    /// 2 s, 4 s, 8 s, ... have passed without that end. [any-thread]
    static bool returns_within(std::chrono::nanoseconds timeout, std::function<void()> work,
                               const std::function<void(std::chrono::seconds)>& on_slow = {});

    /// Whether any call of this process has not returned yet. Static objects must not be destroyed while one
    /// is running: such a process ends with exit_process(). [any-thread]
    static bool any_running();
};

} // namespace tandem::process
