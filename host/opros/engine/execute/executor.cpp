// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/executor.hpp"

#include "host/log/log.hpp"
#include "host/process/start_thread.hpp"
#include "host/rt/cycle_lines.hpp"
#include "host/rt/periodic_tick.hpp"
#include "host/rt/thread.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <span>
#include <tuple>

namespace tandem::engine {

Executor::Executor(std::vector<ComponentHost*> components, const ExecutorOptions& options)
    : components_(std::move(components)), options_(options),
      trigger_(make_cycle_trigger(*components_.front(), options.tick_spin, [this] { rehearse(); })) {}

Executor::~Executor() {
    trigger_->interrupt();
    if (shared_tick_) shared_tick_->leave(std::chrono::hours(24 * 365));
    if (thread_.joinable()) thread_.join();
}

void Executor::start() {
    if (thread_.joinable() || shared_tick_ || start_in_shared_thread()) return;
    const auto task = std::make_shared<std::packaged_task<void()>>([this] { run(); });
    end_ = task->get_future();
    thread_ = process::start_thread([task] { (*task)(); });
}

/// Returns false if the executor needs a separate thread. A thread that polls, as its user has asked, cannot be shared.
bool Executor::start_in_shared_thread() {
    rt::PeriodicTick* const tick = trigger_->tick();
    if (!tick || (options_.tick_spin && options_.tick_spin->count() > 0)) return false;
    const ComponentProfile& profile = components_.front()->profile();
    if (profile.has_exclusive_thread) return false;
    separate_thread_ = rt::take_separate_tick_thread();
    if (separate_thread_) return false;
    const auto cycle = [this, tick](const rt::ArrivedTick& arrived) {
        const crash::CallbackPublication publication(trigger_->callback_text());
        tick->tick_at(arrived);
        run_cycle();
        return rt::SharedTick::Next::tick;
    };
    rt::ThreadOptions thread = thread_options();
    thread.name = "shared-ticks";
    const auto write_log = [](const std::string& line) { log::info("{}", line); };
    shared_tick_ = rt::SharedTick::start({profile.period, profile.phase, thread},
                                         {cycle,
                                          [this, tick] {
                                              note_lines();
                                              tick->note_lines();
                                              rehearse();
                                          },
                                          components_.front()->name(), write_log},
                                         rt::SharedTick::Next::tick);
    return true;
}

bool Executor::stop_within(std::chrono::nanoseconds timeout) {
    trigger_->interrupt();
    if (shared_tick_) return shared_tick_->leave(timeout);
    return !end_.valid() || end_.wait_for(timeout) == std::future_status::ready;
}

bool Executor::runs(const ComponentHost& component) const {
    return std::find(components_.begin(), components_.end(), &component) != components_.end();
}

std::string Executor::stats() const {
    std::string names;
    for (const ComponentHost* component : components_)
        names += (names.empty() ? "" : ", ") + component->name();
    return "executor of " + names + ": " + trigger_->stats();
}

rt::ThreadOptions Executor::thread_options() const {
    const ComponentProfile& profile = components_.front()->profile();
    rt::ThreadOptions options{components_.front()->name(), 0, options_.cpu, false};
    // Never for a loop without pauses: at a real-time priority it would keep all other threads off its processor.
    if (profile.scheduling_policy != SchedulingPolicy::other &&
        profile.execution_type != ExecutionType::aperiodic_loop) {
        options.fifo_priority = profile.priority;
        options.round_robin = profile.scheduling_policy == SchedulingPolicy::round_robin;
    }
    return options;
}

void Executor::run() {
    for (const std::string& notice : rt::configure_this_thread(thread_options())) log::info("{}", notice);
    const crash::CallbackPublication publication(trigger_->callback_text());
    // A loop without pauses may wait for its device inside a cycle, so its cycles have no bound.
    const bool event_driven = components_.front()->profile().execution_type == ExecutionType::aperiodic;
    while (trigger_->wait()) {
        if (event_driven) components_.front()->publish_cycle(rt::monotonic_ns());
        run_cycle();
        if (event_driven) components_.front()->publish_cycle(0);
    }
}

// All components run onExecute before the first runs onUpdated. So a component publishes its results when all
// components have read their inputs. ComponentHost logs an exception, which does not end the cycle of the other
// components.
void Executor::run_cycle() {
    for (ComponentHost* component : components_) {
        const bool active = component->is_active();
        if (active && !component->consume_dependency_cycles()) continue;
        component->execute();
        if (active) component->notify_dependents();
    }
    for (ComponentHost* component : components_) component->update();
}

// Calls the same function as the cycle, so that the caches hold the code that will run.
void Executor::rehearse() {
    for (ComponentHost* component : components_) component->execute();
}

/// Reports the lines that a cycle in a shared thread uses besides those of the tick and the components.
void Executor::note_lines() const {
    const std::span all(components_.data(), components_.size());
    rt::note_lines(this, sizeof *this);
    rt::note_lines(all.data(), all.size_bytes());
    rt::note_lines(trigger_.get(), sizeof(void*)); // its virtual functions
}

std::vector<std::unique_ptr<Executor>> make_executors(const std::vector<ComponentHost*>& components,
                                                      const ExecutorOptions& options) {
    std::vector<std::vector<ComponentHost*>> groups;
    // Returns the index in `groups` of the periodic-shared components with this period, phase, policy and priority.
    std::map<std::tuple<std::int64_t, std::int64_t, SchedulingPolicy, int>, std::size_t> shared;
    for (ComponentHost* component : components) {
        const ComponentProfile& profile = component->profile();
        if (component->has_failed() || profile.execution_type == ExecutionType::passive) continue;
        if (profile.execution_type == ExecutionType::periodic_shared) {
            const auto [entry, added] = shared.try_emplace(
                {profile.period.count(), profile.phase.count(), profile.scheduling_policy, profile.priority},
                groups.size());
            if (!added) {
                groups[entry->second].push_back(component);
                continue;
            }
        }
        groups.push_back({component});
    }
    std::vector<std::unique_ptr<Executor>> executors;
    executors.reserve(groups.size());
    for (auto& group : groups) executors.push_back(std::make_unique<Executor>(std::move(group), options));
    return executors;
}

} // namespace tandem::engine
