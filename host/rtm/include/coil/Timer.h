// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_TIMER_H
#define COIL_TIMER_H
#include <chrono>
#include <functional>
#include <iterator>
#include <list>
#include <memory>
#include <mutex>
#include <utility>

namespace coil {

/// A function that is called once, after its delay.
class DelayedFunction {
  public:
    DelayedFunction(std::function<void()> fn, std::chrono::nanoseconds delay) noexcept
        : m_fn(std::move(fn)), m_remains(delay) {}
    /// Returns true if it has been called and can be dropped.
    bool tick(std::chrono::nanoseconds interval) {
        m_remains -= interval;
        if (m_remains.count() > 0) return false;
        m_fn();
        return true;
    }

  private:
    std::function<void()> m_fn;
    std::chrono::nanoseconds m_remains;
};

/// A function that is called once per period until stop().
class PeriodicFunction {
  public:
    PeriodicFunction(std::function<void()> fn, std::chrono::nanoseconds period) noexcept
        : m_fn(std::move(fn)), m_remains(period), m_period(period) {}
    bool tick(std::chrono::nanoseconds interval) {
        std::lock_guard<std::mutex> lock(m_mutex);
        if (m_stopped) return true;
        m_remains -= interval;
        if (m_remains.count() > 0) return false;
        m_remains += m_period;
        m_fn();
        return false;
    }
    void stop() {
        std::lock_guard<std::mutex> lock(m_mutex);
        m_stopped = true;
    }

  private:
    std::function<void()> m_fn;
    std::chrono::nanoseconds m_remains;
    std::chrono::nanoseconds m_period;
    bool m_stopped = false;
    std::mutex m_mutex;
};

/// A list of functions that run in the thread that calls tick(). emplace(): [any-thread], even from within a
/// function.
template <class Function>
class Timer {
  public:
    using TaskId = Function*;
    Timer() = default;
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

    template <class... Args>
    TaskId emplace(Args&&... args) {
        std::lock_guard<std::mutex> lock(m_mutex);
        m_tasks.emplace_back(std::forward<Args>(args)...);
        return &m_tasks.back();
    }
    /// Calls the functions that are due. `interval` is the time since the last tick().
    void tick(std::chrono::nanoseconds interval) {
        std::list<Function> tasks;
        {
            std::lock_guard<std::mutex> lock(m_mutex);
            tasks.swap(m_tasks);
        }
        for (auto at = tasks.begin(); at != tasks.end();)
            at = target(*at).tick(interval) ? tasks.erase(at) : std::next(at);
        std::lock_guard<std::mutex> lock(m_mutex);
        m_tasks.splice(m_tasks.begin(), tasks);
    }

  private:
    template <class F>
    static F& target(F& function) {
        return function;
    }
    template <class F>
    static F& target(F* function) {
        return *function;
    }
    template <class F>
    static F& target(std::unique_ptr<F>& function) {
        return *function;
    }
    template <class F>
    static F& target(std::shared_ptr<F>& function) {
        return *function;
    }

    std::list<Function> m_tasks;
    std::mutex m_mutex;
};

} // namespace coil
#endif
