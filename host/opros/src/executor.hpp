// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/src/component_host.hpp"
#include "host/rt/periodic_tick.hpp"

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
    std::chrono::nanoseconds spin{0};
};

/// A thread that gives cycles to one or more components, on a timer or, aperiodic, one after the other.
class Executor {
  public:
    Executor(std::vector<ComponentHost*> components, const ExecutorOptions& options);
    ~Executor();
    void start();
    /// Asks for the end; the destructor waits for it.
    void interrupt();
    bool runs(const ComponentHost& component) const;

  private:
    void run();

    std::vector<ComponentHost*> components_;
    ExecutorOptions options_;
    std::unique_ptr<rt::PeriodicTick> tick_; // none: aperiodic
    std::atomic<bool> stopping_{false};
    std::thread thread_;
};

/// The executors that the components' profiles ask for: passive components have none, those with type
/// periodic-shared share one with all of the same period, phase and priority.
std::vector<std::unique_ptr<Executor>> make_executors(const std::vector<ComponentHost*>& components,
                                                      const ExecutorOptions& options);

} // namespace tandem::engine
