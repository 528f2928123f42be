// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <csignal>
#include <functional>
#include <memory>
#include <string>

namespace tandem::engine {

/// Waits in a separate thread for a signal that ends the host, so that a set-up with a hanging component can be ended
/// as well. If the set-up does not finish within the grace time after the signal, the process exits with code 1. Logs
/// slow steps of the set-up.
///
/// A second signal ends the process at once, in case a component does not stop. Signals within one second of the
/// first count as the same request, because a terminal, a supervisor and timeout(1) signal both the process and its
/// group.
class ShutdownWatcher {
  public:
    /// The signals must be blocked in all threads of the process. [main-thread]
    ShutdownWatcher(const sigset_t& signals, std::chrono::nanoseconds grace);
    /// Notes that a callback of the set-up begins. [any-thread]
    void begin_step(const std::string& component, const char* callback);
    /// Notes that the set-up is over and blocks until the signal. [main-thread]
    void wait_for_signal();
    /// Returns a function that returns true once a signal has come. Both: [any-thread].
    std::function<bool()> signalled() const;

  private:
    struct State;
    static void watch(State& state, const sigset_t& signals, std::chrono::nanoseconds grace);
    [[noreturn]] static void exit_on_second_signal(const sigset_t& signals);
    std::shared_ptr<State> state_; // shared with the detached thread, which may outlive this object
};

} // namespace tandem::engine
