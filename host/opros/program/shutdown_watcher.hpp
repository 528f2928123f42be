// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <csignal>
#include <memory>
#include <string>

namespace tandem::engine {

/// Waits for one of the signals (which all threads block) in a thread of its own, so that the set-up, too,
/// can be ended: when it is not over `grace` after a signal, the process ends. What takes long in the set-up
/// is told. A second signal ends the process at once, for a component that will not stop; what comes within a
/// second of the first is the same wish, which a terminal, a supervisor or timeout(1) sends to the process
/// and to its group.
class ShutdownWatcher {
  public:
    ShutdownWatcher(const sigset_t& signals, std::chrono::nanoseconds grace);
    /// [any-thread] What the set-up is busy with from now on.
    void begin_step(const std::string& component, const char* step);
    /// The set-up is over: waits for the signal.
    void wait_for_signal();

  private:
    struct State;
    static void watch(State& state, const sigset_t& signals, std::chrono::nanoseconds grace);
    [[noreturn]] static void exit_on_second_signal(const sigset_t& signals);
    std::shared_ptr<State> state_; // the thread has it, too, and may outlive this
};

} // namespace tandem::engine
