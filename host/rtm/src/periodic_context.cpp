// SPDX-License-Identifier: Apache-2.0
#include "host/rt/periodic_tick.hpp"
#include "host/rt/thread.hpp"
#include "manager_options.hpp"
#include <atomic>
#include <rtm/OpenHRPExecutionContext.h>
#include <rtm/PeriodicExecutionContext.h>

namespace RTC_exp {

using tandem::rt::PeriodicTick;

/// What the thread and its context share; the context may be gone before a thread that hangs in a component.
struct PeriodicExecutionContext::Worker {
    std::mutex mutex;
    std::condition_variable wake;
    std::shared_ptr<PeriodicTick> tick; // replaced when the rate changes
    bool ending = false;
    bool ended = false;
    bool requested = false;
    bool hangs = false; // a stop has waited in vain
    std::thread thread;
};

PeriodicExecutionContext::PeriodicExecutionContext() : ExecutionContextServant("periodic_ec") {}
PeriodicExecutionContext::~PeriodicExecutionContext() { onStopping(); }

std::shared_ptr<PeriodicExecutionContext::Worker> PeriodicExecutionContext::worker() const {
    std::lock_guard<std::mutex> lock(m_workerMutex);
    return m_worker;
}

bool PeriodicExecutionContext::hasThread() const { return worker() != nullptr; }

void PeriodicExecutionContext::makeTick(Worker& worker) {
    const auto spin = RTC::host_options().tick_spin;
    worker.tick = std::make_shared<PeriodicTick>(tandem::rt::TickOptions{getPeriod(), m_phase, true, spin});
}

RTC::ReturnCode_t PeriodicExecutionContext::onStarted() {
    auto started = std::make_shared<Worker>();
    makeTick(*started);
    started->thread = std::thread([this, started] { run(*started); });
    std::lock_guard<std::mutex> lock(m_workerMutex);
    m_worker = started;
    return RTC::RTC_OK;
}

void PeriodicExecutionContext::run(Worker& worker) {
    int cpu = RTC::host_options().cpu, priority = 0;
    coil::stringTo(cpu, m_properties.getProperty("cpu_affinity").c_str());
    coil::stringTo(priority, m_properties.getProperty("priority").c_str());
    for (const auto& notice : tandem::rt::set_up_this_thread({"rtm-ec", priority, cpu}))
        RTC_WARN(("%s", notice.c_str()));

    std::unique_lock<std::mutex> lock(worker.mutex);
    while (!worker.ending) {
        worker.requested = false;
        auto tick = worker.tick;
        lock.unlock();
        const bool work = busy();
        if (work) {
            tick->wait();
            if (!tick->interrupted()) invokeWorker();
        }
        lock.lock();
        if (!work) worker.wake.wait(lock, [&] { return worker.ending || worker.requested; });
    }
    worker.ended = true;
    worker.wake.notify_all();
}

RTC::ReturnCode_t PeriodicExecutionContext::onStopping() {
    auto stopping = worker();
    if (stopping == nullptr) return RTC::RTC_OK;
    {
        std::unique_lock<std::mutex> lock(stopping->mutex);
        stopping->ending = true;
        stopping->tick->interrupt();
        stopping->wake.notify_all();
        if (insideCycle()) return RTC::RTC_OK; // the thread ends after this cycle
        if (stopping->hangs && !stopping->ended) return RTC::RTC_ERROR;
        stopping->hangs =
            !stopping->wake.wait_for(lock, RTC::host_options().stop_timeout, [&] { return stopping->ended; });
        if (stopping->hangs) return RTC::RTC_ERROR; // in a callback; its component must be left behind
    }
    std::lock_guard<std::mutex> lock(m_workerMutex);
    if (m_worker == stopping) {
        stopping->thread.join();
        m_worker.reset();
    }
    return RTC::RTC_OK;
}

RTC::ReturnCode_t PeriodicExecutionContext::onSetRate(double) {
    auto running = worker();
    if (running == nullptr) return RTC::RTC_OK;
    std::lock_guard<std::mutex> lock(running->mutex);
    auto former = running->tick;
    makeTick(*running);
    former->interrupt();
    return RTC::RTC_OK;
}

void PeriodicExecutionContext::onRequest() {
    auto running = worker();
    if (running == nullptr) return;
    std::lock_guard<std::mutex> lock(running->mutex);
    running->requested = true;
    running->wake.notify_all();
}

} // namespace RTC_exp

namespace RTC {

OpenHRPExecutionContext::OpenHRPExecutionContext() : ExecutionContextServant("synch_ext_trigger_ec") {}

void OpenHRPExecutionContext::tick() {
    if (isRunning() && !insideCycle()) invokeWorker();
}

} // namespace RTC
