// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/execute/cycle_trigger.hpp"

#include <future>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace tandem::engine {

/// One cycle of components that are executed together: onExecute of all, then onUpdated of all. Returns what
/// the first one that threw has to say, empty otherwise.
std::string run_cycle(const std::vector<ComponentHost*>& components);

struct ExecutorOptions {
    int cpu = -1;
    std::chrono::nanoseconds tick_spin{0};
};

/// A thread that gives cycles to one or more components at the pace that their profile asks for.
class Executor {
  public:
    Executor(std::vector<ComponentHost*> components, const ExecutorOptions& options);
    /// Waits for the cycle under way, however long it takes: stop_within() first.
    ~Executor();
    void start();
    /// Asks for the end and waits for it; false when a component is still in its cycle by then.
    bool stop_within(std::chrono::nanoseconds grace);
    bool runs(const ComponentHost& component) const;
    const std::vector<ComponentHost*>& components() const { return components_; }
    /// One line of what has been counted.
    std::string stats() const;

  private:
    void run();

    std::vector<ComponentHost*> components_;
    ExecutorOptions options_;
    std::unique_ptr<CycleTrigger> trigger_;
    std::future<void> end_;
    std::thread thread_;
};

/// The executors that the components' profiles ask for: passive components have none, those with type
/// periodic-shared share one with all of the same period, phase and priority.
std::vector<std::unique_ptr<Executor>> make_executors(const std::vector<ComponentHost*>& components,
                                                      const ExecutorOptions& options);

} // namespace tandem::engine
