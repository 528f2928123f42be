// SPDX-License-Identifier: Apache-2.0
// Calls a function periodically in a separate thread, timed by the steady clock, without real-time priority.
#include <coil/PeriodicTask.h>

namespace coil {
namespace {

using Lock = std::unique_lock<std::mutex>;
using Clock = std::chrono::steady_clock;

// The next multiple of the period that is not over yet: calls that are overdue are skipped, the grid is kept.
Clock::time_point next_due(Clock::time_point due, std::chrono::nanoseconds period) {
    const auto now = Clock::now();
    due += period;
    if (due < now) due += period * ((now - due) / period + 1);
    return due;
}

} // namespace

PeriodicTask::~PeriodicTask() {
    // Before the members are destroyed, which the thread uses.
    PeriodicTask::finalize();
    wait();
}

// Does nothing without a function, or when the thread runs already.
void PeriodicTask::activate() {
    {
        Lock lock(m_mutex);
        if (!m_func || m_alive) return;
        m_alive = true;
    }
    // NOLINTNEXTLINE(bugprone-parent-virtual-call): that of PeriodicTaskBase is pure
    Task::activate();
}

void PeriodicTask::finalize() {
    Lock lock(m_mutex);
    m_alive = false;
    m_changed.notify_all();
}

int PeriodicTask::suspend() {
    Lock lock(m_mutex);
    m_suspended = true;
    return 0;
}

// The statistics start again from zero.
int PeriodicTask::resume() {
    Lock lock(m_mutex);
    // The pause must not count as a long period.
    m_cycle.time.reset();
    m_exec.time.reset();
    m_suspended = false;
    m_changed.notify_all();
    return 0;
}

// Signals are counted: each makes one call of a suspended task.
void PeriodicTask::signal() {
    Lock lock(m_mutex);
    if (m_suspended) ++m_signals;
    m_changed.notify_all();
}

void PeriodicTask::setTask(std::function<void()> func) {
    Lock lock(m_mutex);
    m_func = std::move(func);
}

// Takes effect after the next call.
void PeriodicTask::setPeriod(std::chrono::nanoseconds period) {
    Lock lock(m_mutex);
    m_period = period;
}

void PeriodicTask::executionMeasure(bool value) {
    Lock lock(m_mutex);
    m_exec.on = value;
}
void PeriodicTask::executionMeasureCount(unsigned int n) {
    Lock lock(m_mutex);
    m_exec.every = n;
}
void PeriodicTask::periodicMeasure(bool value) {
    Lock lock(m_mutex);
    m_cycle.on = value;
}
void PeriodicTask::periodicMeasureCount(unsigned int n) {
    Lock lock(m_mutex);
    m_cycle.every = n;
}
TimeMeasure::Statistics PeriodicTask::getExecStat() {
    Lock lock(m_mutex);
    return m_exec.last;
}
TimeMeasure::Statistics PeriodicTask::getPeriodStat() {
    Lock lock(m_mutex);
    return m_cycle.last;
}

// [task's thread]
int PeriodicTask::svc() {
    Lock lock(m_mutex);
    auto due = Clock::now();
    while (m_alive) {
        m_changed.wait(lock, [this] { return !m_alive || !m_suspended || m_signals > 0; });
        if (!m_alive) break;
        if (m_signals > 0) --m_signals;
        m_cycle.tack(); // from the last call's begin to this one's
        m_cycle.tick();
        m_exec.tick();
        // A copy, called without the mutex: the function may call setTask(), suspend() or finalize().
        const auto function = m_func;
        lock.unlock();
        function();
        lock.lock();
        m_exec.tack();
        if (m_period.count() <= 0) continue;
        due = next_due(due, m_period);
        m_changed.wait_until(lock, due, [this] { return !m_alive; });
    }
    return 0;
}

void PeriodicTask::Measure::tick() {
    if (on) time.tick();
}

// Publishes the statistics after every `every` measurements, so that readers see complete sets.
void PeriodicTask::Measure::tack() {
    if (!on) return;
    time.tack();
    if (time.count() < every) return;
    last = time.getStatistics();
    time.reset();
}

} // namespace coil
