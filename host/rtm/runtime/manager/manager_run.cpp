// SPDX-License-Identifier: Apache-2.0
// The manager's main loop: tasks, clean-up of components that have exited, and the decision to end.
// OpenRTM-aist: Manager::runManager(), terminate(), invoke(), addTask(), shutdownOnNoRtcs(), checkNoRtcs().
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <algorithm>
#include <atomic>
#include <csignal>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace RTC {
namespace {

// Written by terminate(), also within signal handlers, and by invoke(); read by the main loop. An eventfd,
// because write() is async-signal-safe and a condition variable is not.
const int wake_fd = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
std::atomic<int> termination_requested{0}; // lock-free, therefore allowed in signal handlers

using Clock = std::chrono::steady_clock;

/// Waits until `next` at the latest. Clock::time_point::max() means without a time limit.
void wait_for_wake_up(Clock::time_point next) {
    pollfd fd{wake_fd, POLLIN, 0};
    // A wait of weeks would overflow, so the loop wakes up at least once a day.
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now());
    const auto bounded =
        std::clamp<std::chrono::milliseconds>(left, std::chrono::milliseconds(0), std::chrono::hours(24));
    const bool forever = next == Clock::time_point::max();
    if (::poll(&fd, 1, forever ? -1 : static_cast<int>(bounded.count())) <= 0) return;
    std::uint64_t count;
    [[maybe_unused]] const auto got = ::read(wake_fd, &count, sizeof count);
}

void on_signal(int) { Manager::terminate(); }

// Keeps a handler that the program has installed.
void install_signal_handler(int number) {
    struct sigaction present;
    if (sigaction(number, nullptr, &present) == 0 && present.sa_handler != SIG_DFL) return;
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigaction(number, &action, nullptr);
}

// Decides whether a manager without components ends. manager.shutdown_auto and manager.auto_shutdown_duration apply to
// a manager that stays without components; manager.shutdown_on_nortcs applies when the last component has gone. A
// master manager stays, because tools create components in it.
class IdleShutdown {
  public:
    explicit IdleShutdown(const coil::Properties& config) {
        auto yes = [&](const char* key) { return coil::toBool(config.getProperty(key), "YES", "NO", true); };
        const bool master = coil::toBool(config.getProperty("manager.is_master"), "YES", "NO", false);
        after_idle_time_ = !master && yes("manager.shutdown_auto");
        after_last_component_ = !master && yes("manager.shutdown_on_nortcs");
        double seconds = 20;
        coil::stringTo(seconds, config.getProperty("manager.auto_shutdown_duration").c_str());
        max_idle_time_ = std::chrono::duration<double>(seconds);
    }
    /// Call it in each round of the main loop.
    bool is_due(bool has_components, bool ever_had_components) {
        const auto now = Clock::now();
        if (has_components || had_components_) idle_since_ = now;
        had_components_ = has_components;
        if (!has_components && ever_had_components && after_last_component_) return true;
        return !has_components && after_idle_time_ && now - idle_since_ > max_idle_time_;
    }
    /// Returns when the end may be due if no component appears before.
    Clock::time_point next_check() const {
        if (had_components_ || !after_idle_time_) return Clock::time_point::max();
        // One millisecond more, because the loop may be woken at exactly that time.
        return idle_since_ + std::chrono::ceil<Clock::duration>(max_idle_time_) +
               std::chrono::milliseconds(1);
    }

  private:
    bool after_idle_time_ = false, after_last_component_ = false, had_components_ = false;
    std::chrono::duration<double> max_idle_time_{};
    Clock::time_point idle_since_ = Clock::now();
};

} // namespace

void wake_main_loop() {
    const std::uint64_t increment = 1;
    // The write fails only when the counter is full; then a wake-up is pending anyway.
    [[maybe_unused]] const auto written = ::write(wake_fd, &increment, sizeof increment);
}

void Manager::terminate() {
    termination_requested = 1;
    wake_main_loop();
}

bool Manager::terminationRequested() { return termination_requested != 0; }

// In OpenRTM-aist this waits for the thread that terminate() starts. Here runManager() itself shuts down.
void Manager::join() {}

void Manager::runManager(bool no_block) {
    // The caller continues without a main loop. Tasks of invoke() and addTask() then wait for shutdown().
    if (no_block) return m_impl->note_run();
    for (int number : {SIGINT, SIGTERM, SIGHUP}) install_signal_handler(number);
    IdleShutdown idle_shutdown(m_impl->config_snapshot());
    Clock::time_point next_round = Clock::now();
    m_impl->set_main_loop(std::this_thread::get_id());
    while (!termination_requested) {
        wait_for_wake_up(next_round);
        m_impl->run_due_tasks();
        m_impl->log_slow_transitions();
        if (idle_shutdown.is_due(m_impl->has_components(), m_impl->ever_had_components)) break;
        next_round = std::min(m_impl->next_round(), idle_shutdown.next_check());
    }
    m_impl->end(*this);
    m_impl->set_main_loop({});
}

/// An exited component counts until it is deleted, because its exit() may not have returned yet.
bool Manager::Impl::has_components() const {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    return !components.empty() || !finalized.empty();
}

/// Returns when the main loop must run again if nothing wakes it: for the next task, or for callbacks that may be slow.
std::chrono::steady_clock::time_point Manager::Impl::next_round() const {
    constexpr std::chrono::milliseconds slow_callback_check{100};
    auto next = Clock::time_point::max();
    if (slow_transitions.needs_check()) next = Clock::now() + slow_callback_check;
    std::lock_guard<std::recursive_mutex> lock(mutex);
    for (const auto& task : tasks) next = std::min(next, task.first);
    return next;
}

void Manager::invoke(std::function<void()> fn, std::chrono::nanoseconds delay) {
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        m_impl->tasks.emplace_back(std::chrono::steady_clock::now() + delay, std::move(fn));
    }
    wake_main_loop();
}

Manager::TaskId Manager::addTask(std::function<void()> fn, std::chrono::nanoseconds period) {
    auto task = std::make_shared<coil::PeriodicFunction>(std::move(fn), period);
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        m_impl->periodic_tasks.push_back(task);
    }
    m_impl->schedule_periodic(*this, task, period);
    return task.get();
}

// Each run schedules the next one, until tick() says that the task was stopped.
void Manager::Impl::schedule_periodic(Manager& manager, const std::shared_ptr<coil::PeriodicFunction>& task,
                                      std::chrono::nanoseconds period) {
    manager.invoke(
        [this, &manager, task, period] {
            if (!task->tick(period)) return schedule_periodic(manager, task, period);
            std::lock_guard<std::recursive_mutex> lock(mutex);
            std::erase(periodic_tasks, task);
        },
        period);
}

// Holds the mutex, so that no component is deleted meanwhile. Calls no code of a component.
void Manager::Impl::log_slow_transitions() {
    std::vector<std::string> lines;
    {
        std::lock_guard<std::recursive_mutex> lock(mutex);
        std::vector<RTObject_impl*> all;
        for (auto& component : components) all.push_back(component.object);
        for (auto& [name, creation] : being_created)
            if (creation.component != nullptr) all.push_back(creation.component);
        lines = slow_transitions.check(all);
    }
    Logger& rtclog = log;
    for (const auto& line : lines) RTC_WARN(("%s", line.c_str()));
}

// Tasks run without the mutex, because they add tasks and call components.
void Manager::Impl::run_due_tasks() {
    std::vector<std::function<void()>> due;
    {
        std::lock_guard<std::recursive_mutex> lock(mutex);
        const auto now = std::chrono::steady_clock::now();
        for (auto& task : tasks)
            if (task.first <= now) due.push_back(std::move(task.second));
        std::erase_if(tasks, [&](const auto& task) { return task.first <= now; });
    }
    for (auto& task : due) task();
}

bool Manager::stoppedInOrder() const {
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    return m_impl->left_behind.empty();
}
bool Manager::restartRequested() const { return m_impl->restart_requested; }

} // namespace RTC
