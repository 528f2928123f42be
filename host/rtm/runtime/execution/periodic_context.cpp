// SPDX-License-Identifier: Apache-2.0
// PeriodicExecutionContext: cycles in a separate thread or in one that contexts of equal rate share. Neither wakes up while no
// component is active.
#include "host/crash/callback_scope.hpp"
#include "host/process/start_thread.hpp"
#include "host/rt/periodic_tick.hpp"
#include "host/rt/shared_tick.hpp"
#include "host/rt/thread.hpp"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <rtm/Manager.h>
#include <rtm/PeriodicExecutionContext.h>
#include <typeinfo>
#include <utility>

namespace RTC_exp {

using tandem::rt::PeriodicTick;
using tandem::rt::SharedTick;

/// Shared by the thread and its context, because a thread that hangs in a component's callback may outlive the context.
struct PeriodicExecutionContext::Worker {
    /// Since the thread looked, another thread has set one of the three members marked below. A cycle without such a change
    /// takes no lock here.
    std::atomic<bool> changed{true};
    // Used by the thread alone:
    bool has_work = false;
    bool has_rested = false; // no component was active, so that a cycle need not wait for a tick
    std::shared_ptr<PeriodicTick> current_tick;

    std::mutex mutex;
    std::condition_variable wake;
    std::shared_ptr<PeriodicTick> tick; // replaced when the rate changes (marked), and after a rest
    TickStatistics previous;            // counted by its predecessors
    bool stop_requested = false;        // marked
    bool finished = false;
    bool transition_requested = false; // marked
    bool callback_hangs = false;       // a stop has waited for it without success
    std::thread thread;                // or:
    std::shared_ptr<SharedTick> shared_tick;
    std::shared_ptr<void> separate_thread; // token of tandem::rt::take_separate_tick_thread()

    TickStatistics tickStatistics() const; // with the mutex held
    bool acceptChange();
    template <class WaitForTick>
    SharedTick::Next step(PeriodicExecutionContext& context, const WaitForTick& wait_for_tick);
    bool leaveSharedTick(std::unique_lock<std::mutex>& lock);
    void logOverruns(PeriodicExecutionContext& context) const;
};

PeriodicExecutionContext::PeriodicExecutionContext() : ExecutionContextServant("periodic_ec") {}
PeriodicExecutionContext::~PeriodicExecutionContext() { onStopping(); }

std::shared_ptr<PeriodicExecutionContext::Worker> PeriodicExecutionContext::worker() const {
    std::lock_guard<std::mutex> lock(m_workerMutex);
    return m_worker;
}

bool PeriodicExecutionContext::hasThread() const { return worker() != nullptr; }

PeriodicExecutionContext::TickStatistics PeriodicExecutionContext::Worker::tickStatistics() const {
    const auto now = tick->stats();
    return {previous.cycles + now.ticks, previous.overruns + now.overruns, previous.skipped + now.skipped,
            std::max(previous.max_lateness, std::chrono::nanoseconds(now.lateness_ns_max))};
}

// Begins a new grid of ticks with the current rate, and keeps the sum of the previous grids' statistics. The
// caller holds the worker's mutex, or the worker is not shared yet.
void PeriodicExecutionContext::createTick(Worker& worker) {
    if (worker.tick) worker.previous = worker.tickStatistics();
    const auto spin = RTC::host_options().tick_spin;
    worker.tick = std::make_shared<PeriodicTick>(tandem::rt::TickOptions{
        getPeriod(), m_phase, true, spin, [this] { rehearse(); }, m_properties.getProperty("tick.owner")});
}

PeriodicExecutionContext::TickStatistics PeriodicExecutionContext::tickStatistics() const {
    const auto running = worker();
    if (running == nullptr) {
        std::lock_guard<std::mutex> lock(m_workerMutex);
        return m_finishedStatistics;
    }
    std::lock_guard<std::mutex> lock(running->mutex);
    return running->tickStatistics();
}

void PeriodicExecutionContext::addStatistics(coil::Properties& properties) {
    const TickStatistics counted = tickStatistics();
    properties.setProperty("tick.cycles", std::to_string(counted.cycles));
    properties.setProperty("tick.overruns", std::to_string(counted.overruns));
    properties.setProperty("tick.skipped", std::to_string(counted.skipped));
    properties.setProperty("tick.latest_us", std::to_string(counted.max_lateness.count() / 1000));
}

namespace {

// Contexts that ask for a priority or processors have separate threads, and so have all where the user asks for polling.
bool mayShareThread(const coil::Properties& properties) {
    const auto spin = RTC::host_options().tick_spin;
    int priority = 0;
    coil::stringTo(priority, properties.getProperty("priority").c_str());
    return priority == 0 && properties.getProperty("cpu_affinity").empty() && (!spin || spin->count() == 0);
}

tandem::rt::SharedTickOptions sharedTickOptions(std::chrono::nanoseconds period,
                                                std::chrono::nanoseconds phase) {
    return {period, phase, {"rtm-ec", 0, RTC::host_options().cpu}};
}

} // namespace

RTC::ReturnCode_t PeriodicExecutionContext::onStarted() {
    auto started = std::make_shared<Worker>();
    createTick(*started);
    started->current_tick = started->tick;
    started->has_rested = !hasWork();
    // A derived class may rely on its thread.
    if (typeid(*this) != typeid(PeriodicExecutionContext) || !mayShareThread(m_properties) ||
        (started->separate_thread = tandem::rt::take_separate_tick_thread())) {
        // Under the mutex: a stop() in the thread's first cycle must find m_worker set.
        std::lock_guard<std::mutex> lock(m_workerMutex);
        started->thread = tandem::process::start_thread([this, started] { run(*started); });
        m_worker = started;
        return RTC::RTC_OK;
    }
    // Small enough for the memory of the std::function itself. `rehearse_cycle` owns the worker.
    const auto cycle = [this, worker = started.get()](const tandem::rt::ArrivedTick& arrived) {
        // Else each call registers the thread, which takes as long.
        thread_local const omni_thread::ensure_self known_to_orb;
        return worker->step(*this, [&](PeriodicTick& tick) { tick.tick_at(arrived); });
    };
    const auto rehearse_cycle = [this, started] {
        tandem::rt::note_lines(started.get(), offsetof(Worker, mutex));
        started->current_tick->note_lines();
        rehearse();
    };
    const auto write_log = [this](const std::string& line) { RTC_INFO(("%s", line.c_str())); };
    const auto first = started->has_rested ? SharedTick::Next::rest : SharedTick::Next::tick;
    std::lock_guard<std::mutex> lock(m_workerMutex);
    started->shared_tick =
        SharedTick::start(sharedTickOptions(getPeriod(), m_phase),
                          {cycle, rehearse_cycle, m_properties.getProperty("tick.owner"), write_log}, first);
    m_worker = started;
    // A transition that was requested before m_worker was set has woken nobody.
    if (first == SharedTick::Next::rest && hasWork()) started->shared_tick->wake();
    return RTC::RTC_OK;
}

/// Takes over what other threads have changed. Returns false if the thread must stop. [context's thread]
bool PeriodicExecutionContext::Worker::acceptChange() {
    if (!changed.load(std::memory_order_acquire)) return true;
    std::lock_guard<std::mutex> lock(mutex);
    if (stop_requested) return false;
    changed = transition_requested = false;
    // The thread sleeps on its own pointer: setRate() may replace the tick meanwhile, and then interrupts it.
    current_tick = tick;
    return true;
}

/// Runs a cycle at the next tick, or at once after a rest. Returns `rest`, without a cycle, if no component needs one.
/// [context's thread]
template <class WaitForTick>
SharedTick::Next PeriodicExecutionContext::Worker::step(PeriodicExecutionContext& context,
                                                        const WaitForTick& wait_for_tick) {
    if (!acceptChange()) return SharedTick::Next::rest;
    PeriodicTick& current = *current_tick;
    if (has_work || context.hasWork()) {
        const tandem::crash::CallbackPublication publication(current.callback_text());
        if (has_rested)
            current.begin_cycle();
        else
            wait_for_tick(current);
        if (current.interrupted()) return SharedTick::Next::tick;
        has_work = context.runCycle();
        has_rested = false;
        return SharedTick::Next::tick;
    }
    current.rest();
    std::lock_guard<std::mutex> lock(mutex);
    context.createTick(*this); // periods that are slept through do not count as skipped
    current_tick = tick;
    has_rested = true;
    return SharedTick::Next::rest;
}

void PeriodicExecutionContext::Worker::logOverruns(PeriodicExecutionContext& context) const {
    auto& rtclog = context.rtclog;
    const TickStatistics counted = tickStatistics();
    if (counted.overruns > 0)
        RTC_WARN(("%llu of %llu cycles overran their period of %g ms; %llu periods had no cycle",
                  static_cast<unsigned long long>(counted.overruns),
                  static_cast<unsigned long long>(counted.cycles), 1e-6 * double(context.getPeriod().count()),
                  static_cast<unsigned long long>(counted.skipped)));
}

// [context's thread]
void PeriodicExecutionContext::run(Worker& worker) {
    const omni_thread::ensure_self known_to_orb; // else each call registers the thread, which takes as long
    int priority = 0;
    std::vector<int> cpus;
    coil::stringTo(priority, m_properties.getProperty("priority").c_str());
    for (const auto& notice :
         tandem::rt::configure_this_thread({"rtm-ec", priority, RTC::host_options().cpu}))
        RTC_WARN(("%s", notice.c_str()));
    if (coil::stringTo(cpus, m_properties.getProperty("cpu_affinity").c_str()) && !cpus.empty())
        if (const auto notice = tandem::rt::pin_this_thread("thread rtm-ec", cpus))
            RTC_WARN(("%s", notice->c_str()));

    for (;;) {
        const auto next = worker.step(*this, [](PeriodicTick& tick) { tick.wait(); });
        if (next == SharedTick::Next::tick && !worker.changed) continue;
        std::unique_lock<std::mutex> lock(worker.mutex);
        if (next == SharedTick::Next::rest)
            worker.wake.wait(lock, [&] { return worker.stop_requested || worker.transition_requested; });
        if (!worker.stop_requested) continue;
        worker.logOverruns(*this);
        worker.finished = true;
        worker.wake.notify_all();
        return;
    }
}

// Without the mutex, which the current cycle may need to end.
bool PeriodicExecutionContext::Worker::leaveSharedTick(std::unique_lock<std::mutex>& lock) {
    const auto timeout = callback_hangs ? std::chrono::nanoseconds(0) : RTC::host_options().stop_timeout;
    const auto leaving = shared_tick;
    lock.unlock();
    const bool has_left = leaving->leave(timeout);
    lock.lock();
    return has_left;
}

RTC::ReturnCode_t PeriodicExecutionContext::onStopping() {
    auto stopping = worker();
    if (stopping == nullptr) return RTC::RTC_OK;
    {
        std::unique_lock<std::mutex> lock(stopping->mutex);
        stopping->stop_requested = stopping->changed = true;
        stopping->tick->interrupt();
        stopping->wake.notify_all();
        if (stopping->shared_tick) stopping->finished = stopping->leaveSharedTick(lock);
        if (isInsideCycle()) return RTC::RTC_OK; // this is that thread: it ends after the cycle
        if (stopping->callback_hangs && !stopping->finished) return RTC::RTC_ERROR;
        stopping->callback_hangs =
            !stopping->finished &&
            (stopping->shared_tick || !stopping->wake.wait_for(lock, RTC::host_options().stop_timeout,
                                                               [&] { return stopping->finished; }));
        if (stopping->callback_hangs)
            return RTC::RTC_ERROR; // the thread is in a callback: its component cannot be deleted
    }
    // Another thread may have stopped it at the same time; only one of them joins.
    std::lock_guard<std::mutex> lock(m_workerMutex);
    if (m_worker == stopping) {
        if (stopping->thread.joinable()) stopping->thread.join();
        std::lock_guard<std::mutex> worker_lock(stopping->mutex);
        if (std::exchange(stopping->shared_tick, nullptr)) stopping->logOverruns(*this);
        m_finishedStatistics = stopping->tickStatistics();
        m_worker.reset();
    }
    return RTC::RTC_OK;
}

RTC::ReturnCode_t PeriodicExecutionContext::onSetRate(double) {
    auto running = worker();
    if (running == nullptr) return RTC::RTC_OK;
    std::lock_guard<std::mutex> lock(running->mutex);
    // The thread may be waiting for a tick of the old rate. The interruption makes it continue with the new one.
    auto old_tick = running->tick;
    createTick(*running);
    running->changed = true;
    old_tick->interrupt();
    if (running->shared_tick) running->shared_tick->change(sharedTickOptions(getPeriod(), m_phase));
    return RTC::RTC_OK;
}

void PeriodicExecutionContext::onTransitionRequested() {
    auto running = worker();
    if (running == nullptr) return;
    std::lock_guard<std::mutex> lock(running->mutex);
    running->transition_requested = running->changed = true;
    running->wake.notify_all();
    if (running->shared_tick) running->shared_tick->wake();
}

} // namespace RTC_exp

void PeriodicExecutionContextInit(RTC::Manager* manager) {
    manager->registerECFactory("PeriodicExecutionContext", RTC::ECCreate<RTC_exp::PeriodicExecutionContext>,
                               RTC::ECDelete<RTC_exp::PeriodicExecutionContext>);
}
