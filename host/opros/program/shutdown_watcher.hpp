// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <csignal>
#include <functional>
#include <memory>
#include <string>

namespace tandem::engine {

/// Waits for a signal that asks the host to end, in a thread of its own, so that a set-up in which a component
/// hangs can be ended as well: when the set-up is not over within the grace time after the signal, the process
/// exits with code 1. A step of the set-up that takes long is logged.
///
/// A second signal ends the process at once, for a component that does not stop. Signals within one second of
/// the first count as the same request: a terminal, a supervisor and timeout(1) send theirs to the process and to
/// its group.
class ShutdownWatcher {
  public:
    /// [main-thread] The signals must be blocked in all threads of the process.
    ShutdownWatcher(const sigset_t& signals, std::chrono::nanoseconds grace);
    /// [any-thread] A callback of the set-up begins.
    void begin_step(const std::string& component, const char* callback);
    /// [main-thread] The set-up is over: waits for the signal.
    void wait_for_signal();
    /// Returns a function that says whether a signal has come. [any-thread] both
    std::function<bool()> signalled() const;

  private:
    struct State;
    static void watch(State& state, const sigset_t& signals, std::chrono::nanoseconds grace);
    [[noreturn]] static void exit_on_second_signal(const sigset_t& signals);
    std::shared_ptr<State> state_; // shared with the thread, which is detached and may outlive this object
};

} // namespace tandem::engine
