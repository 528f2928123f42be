// SPDX-License-Identifier: Apache-2.0
#include "host/opros/src/executor.hpp"

#include "host/rt/thread.hpp"

#include <algorithm>
#include <map>
#include <spdlog/spdlog.h>
#include <tuple>

namespace tandem::engine {

std::string run_cycle(const std::vector<ComponentHost*>& components) {
    std::string first;
    for (ComponentHost* component : components) {
        const bool active = component->active();
        if (active && !component->take_triggers()) continue;
        if (std::string text = component->execute(); !text.empty() && first.empty()) first = std::move(text);
        if (active) component->fired();
    }
    for (ComponentHost* component : components)
        if (std::string text = component->update(); !text.empty() && first.empty()) first = std::move(text);
    return first;
}

Executor::Executor(std::vector<ComponentHost*> components, const ExecutorOptions& options)
    : components_(std::move(components)), options_(options) {
    const ComponentProfile& profile = components_.front()->profile();
    if (profile.execution != Execution::aperiodic)
        tick_ = std::make_unique<rt::PeriodicTick>(
            rt::TickOptions{profile.period, profile.phase, true, options_.spin});
}

Executor::~Executor() {
    interrupt();
    if (thread_.joinable()) thread_.join();
}

void Executor::start() {
    if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
}

void Executor::interrupt() {
    stopping_ = true;
    if (tick_) tick_->interrupt();
}

bool Executor::runs(const ComponentHost& component) const {
    return std::find(components_.begin(), components_.end(), &component) != components_.end();
}

void Executor::run() {
    // A loop without pauses at a real-time priority would take a processor from everybody else.
    const int priority = tick_ ? components_.front()->profile().priority : 0;
    for (const std::string& notice :
         rt::set_up_this_thread({components_.front()->name(), priority, options_.cpu}))
        spdlog::info("{}", notice);
    while (!stopping_) {
        if (tick_) {
            tick_->wait();
            if (tick_->interrupted()) return;
        } else if (!components_.front()->active()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        run_cycle(components_);
    }
}

std::vector<std::unique_ptr<Executor>> make_executors(const std::vector<ComponentHost*>& components,
                                                      const ExecutorOptions& options) {
    std::vector<std::vector<ComponentHost*>> groups;
    std::map<std::tuple<std::int64_t, std::int64_t, int>, std::size_t> shared;
    for (ComponentHost* component : components) {
        const ComponentProfile& profile = component->profile();
        if (component->failed() || profile.execution == Execution::passive) continue;
        if (profile.execution == Execution::periodic_shared) {
            const auto [entry, added] = shared.try_emplace(
                {profile.period.count(), profile.phase.count(), profile.priority}, groups.size());
            if (!added) {
                groups[entry->second].push_back(component);
                continue;
            }
        }
        groups.push_back({component});
    }
    std::vector<std::unique_ptr<Executor>> executors;
    for (auto& group : groups) executors.push_back(std::make_unique<Executor>(std::move(group), options));
    return executors;
}

} // namespace tandem::engine
