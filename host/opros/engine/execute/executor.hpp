// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/execute/cycle_trigger.hpp"
#include "host/rt/shared_tick.hpp"

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tandem::engine {

struct ExecutorOptions {
    int cpu = -1; ///< the threads run on this processor only; -1: on any processor
    /// Time before each periodic tick in which the thread polls instead of sleeping; none: the default of
    /// rt::TickOptions.
    std::optional<std::chrono::nanoseconds> tick_spin;
};

/// Runs the cycles of one component, or of several components with the same period, when their trigger says so: in a
/// separate thread, or in one that it shares with other executors (rt::SharedTick). [main-thread] for all functions. The
/// components must outlive it.
class Executor {
  public:
    /// `components` must not be empty. The profile of the first one determines the trigger and the scheduling.
    Executor(std::vector<ComponentHost*> components, const ExecutorOptions& options);
    /// Waits for the current cycle without a time limit. So call stop_within() first, and leak an executor that has not
    /// stopped.
    ~Executor();
    /// Begins the cycles, unless they have begun. If the system refuses real-time scheduling, logs that and runs the thread
    /// without it.
    void start();
    /// Ends the cycles and waits for the current one. Returns false if it is still in a component's code after `timeout`.
    bool stop_within(std::chrono::nanoseconds timeout);
    bool runs(const ComponentHost& component) const;
    const std::vector<ComponentHost*>& components() const { return components_; }
    /// [any-thread] Returns the components' names and the trigger's counters in one line.
    std::string stats() const;

  private:
    void run();
    void run_cycle();
    rt::ThreadOptions thread_options() const;
    bool start_in_shared_thread();
    void rehearse();
    void note_lines() const;

    std::vector<ComponentHost*> components_;
    ExecutorOptions options_;
    std::unique_ptr<CycleTrigger> trigger_;
    std::future<void> end_; // ready when run() has returned: a std::thread cannot be joined with a timeout
    std::thread thread_;
    std::shared_ptr<void> separate_thread_; // token of rt::take_separate_tick_thread()
    std::shared_ptr<rt::SharedTick> shared_tick_;
};

/// Creates the executors that the components' profiles ask for: none for passive and failed components, one for all
/// periodic-shared components of the same period, phase and scheduling, and a separate one for each other component.
std::vector<std::unique_ptr<Executor>> make_executors(const std::vector<ComponentHost*>& components,
                                                      const ExecutorOptions& options);

} // namespace tandem::engine
