// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/execute/cycle_trigger.hpp"

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tandem::engine {

struct ExecutorOptions {
    int cpu = -1; ///< the threads run on this processor only; -1: on any
    /// Polled before each periodic tick instead of slept; none: as rt::TickOptions says.
    std::optional<std::chrono::nanoseconds> tick_spin;
};

/// A thread that runs the cycles of one component, or of several with the same period, as their trigger says.
/// [main-thread] all but the thread itself. The components must outlive it.
class Executor {
  public:
    /// `components`: at least one. The first one's profile decides on trigger and scheduling.
    Executor(std::vector<ComponentHost*> components, const ExecutorOptions& options);
    /// Waits for the cycle under way without a bound: call stop_within() first, and leak an executor that has
    /// not stopped.
    ~Executor();
    /// Creates the thread; does nothing when there is one. Real-time scheduling that the system refuses is
    /// logged, and the thread runs without it.
    void start();
    /// Asks the thread to end and waits for it. False when it is still in a component's code after `timeout`.
    bool stop_within(std::chrono::nanoseconds timeout);
    bool runs(const ComponentHost& component) const;
    const std::vector<ComponentHost*>& components() const { return components_; }
    /// [any-thread] The components' names and what the trigger has counted, in one line.
    std::string stats() const;

  private:
    void run();
    void run_cycle();
    void warm_up();

    std::vector<ComponentHost*> components_;
    ExecutorOptions options_;
    std::unique_ptr<CycleTrigger> trigger_;
    std::future<void> end_; // ready when run() has returned: a std::thread cannot be joined with a timeout
    std::thread thread_;
};

/// The executors that the components' profiles ask for: none for passive and failed components, one for all
/// periodic-shared ones of the same period, phase and scheduling, one of its own for each other component.
std::vector<std::unique_ptr<Executor>> make_executors(const std::vector<ComponentHost*>& components,
                                                      const ExecutorOptions& options);

} // namespace tandem::engine
