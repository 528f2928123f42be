// SPDX-License-Identifier: Apache-2.0
// The execution contexts whose cycles are triggered from outside by tick(): in the caller's thread
// (OpenHRPExecutionContext, SimulatorExecutionContext) or in a thread of the context
// (ExtTrigExecutionContext).
#include "host/process/start_thread.hpp"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include <condition_variable>
#include <rtm/ExtTrigExecutionContext.h>
#include <rtm/Manager.h>
#include <rtm/SimulatorExecutionContext.h>

namespace RTC {

OpenHRPExecutionContext::OpenHRPExecutionContext() : ExecutionContextServant("synch_ext_trigger_ec") {
    m_kind = OTHER;
}

// Does nothing in a stopped context, nor within a callback, where a cycle would wait for itself.
void OpenHRPExecutionContext::tick() {
    if (isRunning() && !isInsideCycle()) invokeWorker();
}

/// Shared by the thread and its context, because a thread that hangs in a component's callback may outlive the context.
struct ExtTrigExecutionContext::Worker {
    std::mutex mutex;
    std::condition_variable wake;
    unsigned long pending_ticks = 0; // ticks whose cycle has not begun
    bool stop_requested = false;
    bool finished = false;
    std::thread thread;
};

ExtTrigExecutionContext::ExtTrigExecutionContext() : ExecutionContextServant("ext_trig_ec") {
    m_kind = OTHER;
}
ExtTrigExecutionContext::~ExtTrigExecutionContext() { onStopping(); }

void ExtTrigExecutionContext::tick() {
    std::lock_guard<std::mutex> lock(m_workerMutex);
    if (m_worker == nullptr) return;
    std::lock_guard<std::mutex> worker_lock(m_worker->mutex);
    ++m_worker->pending_ticks;
    m_worker->wake.notify_all();
}

ReturnCode_t ExtTrigExecutionContext::onStarted() {
    auto started = std::make_shared<Worker>();
    started->thread = tandem::process::start_thread([this, started] { run(*started); });
    std::lock_guard<std::mutex> lock(m_workerMutex);
    m_worker = started;
    return RTC_OK;
}

// [context's thread]
void ExtTrigExecutionContext::run(Worker& worker) {
    const omni_thread::ensure_self known_to_orb; // else each call registers the thread, which takes as long
    std::unique_lock<std::mutex> lock(worker.mutex);
    while (!worker.stop_requested) {
        worker.wake.wait(lock, [&] { return worker.stop_requested || worker.pending_ticks > 0; });
        if (worker.stop_requested) break;
        --worker.pending_ticks;
        lock.unlock();
        invokeWorker();
        lock.lock();
    }
    worker.finished = true;
    worker.wake.notify_all();
}

ReturnCode_t ExtTrigExecutionContext::onStopping() {
    std::shared_ptr<Worker> stopping;
    {
        std::lock_guard<std::mutex> lock(m_workerMutex);
        stopping = m_worker;
    }
    if (stopping == nullptr) return RTC_OK;
    {
        std::unique_lock<std::mutex> lock(stopping->mutex);
        stopping->stop_requested = true;
        stopping->wake.notify_all();
        if (isInsideCycle()) return RTC_OK; // this is that thread: it ends after the cycle
        if (!stopping->wake.wait_for(lock, host_options().stop_timeout, [&] { return stopping->finished; }))
            return RTC_ERROR; // the thread is in a callback: its component cannot be deleted
    }
    // Another thread may have stopped it at the same time; only one joins.
    std::lock_guard<std::mutex> lock(m_workerMutex);
    if (m_worker == stopping) {
        stopping->thread.join();
        m_worker.reset();
    }
    return RTC_OK;
}

} // namespace RTC

void OpenHRPExecutionContextInit(RTC::Manager* manager) {
    manager->registerECFactory("SynchExtTriggerEC", RTC::ECCreate<RTC::OpenHRPExecutionContext>,
                               RTC::ECDelete<RTC::OpenHRPExecutionContext>);
}
void SimulatorExecutionContextInit(RTC::Manager* manager) {
    manager->registerECFactory("SimulatorExecutionContext", RTC::ECCreate<RTC::SimulatorExecutionContext>,
                               RTC::ECDelete<RTC::SimulatorExecutionContext>);
}
void ExtTrigExecutionContextInit(RTC::Manager* manager) {
    manager->registerECFactory("ExtTrigExecutionContext", RTC::ECCreate<RTC::ExtTrigExecutionContext>,
                               RTC::ECDelete<RTC::ExtTrigExecutionContext>);
}
