// SPDX-License-Identifier: Apache-2.0
// The cycle of an execution context, and how requested transitions are carried out.
#include "host/rt/cycle_lines.hpp"
#include "host/rt/rehearsal.hpp"
#include "host/rtm/runtime/execution/rt_object_state_machine.hpp"
#include <algorithm>
#include <rtm/ExecutionContextBase.h>

namespace RTC {

// Relaxed accesses to m_cycleThread suffice: a thread looks for its own writes only.
bool ExecutionContextBase::isInsideCycle() const {
    return m_cycleThread.load(std::memory_order_relaxed) == std::this_thread::get_id();
}

void ExecutionContextBase::invokeWorker() { runCycle(); }

bool ExecutionContextBase::runCycle() {
    const auto [changed_state, has_work] = cycle();
    if (changed_state) {
        // Locking once orders the cycle's changes before a waiter's check, so that no notification is missed.
        { std::lock_guard<std::mutex> lock(m_cycleDoneMutex); }
        m_cycleDone.notify_all();
    }
    return has_work;
}

void ExecutionContextBase::rehearse() {
    using tandem::rt::note_lines;
    note_lines(&m_mutex, sizeof m_mutex + sizeof m_participants + sizeof m_cycleMutex + sizeof m_cycleThread);
    const auto all = participants();
    note_lines(all.get(), sizeof(Participants::element_type));
    note_lines(all->data(), all->size() * sizeof(Participant));
    for (auto& participant : *all) participant->note_lines();
    cycle();
}

ExecutionContextBase::CycleResult ExecutionContextBase::cycle() {
    CycleResult result;
    std::lock_guard<std::timed_mutex> lock(m_cycleMutex);
    m_cycleThread.store(std::this_thread::get_id(), std::memory_order_relaxed);
    // All executions, then all updates: the two passes of OMG RTC's periodic sampled data processing.
    const auto all = participants();
    for (auto& participant : *all) result.changed_state |= participant->applyTransition();
    for (auto& participant : *all) participant->execute();
    if (!tandem::rt::rehearsing())
        for (auto& participant : *all) participant->runStateUpdate();
    for (auto& participant : *all) result.has_work |= !participant->isInactive();
    m_cycleThread.store(std::thread::id(), std::memory_order_relaxed);
    return result;
}

bool ExecutionContextBase::hasWork() {
    std::lock_guard<std::mutex> lock(m_mutex);
    return !std::all_of(m_participants->begin(), m_participants->end(),
                        [](const auto& participant) { return participant->isInactive(); });
}

ReturnCode_t ExecutionContextBase::activateComponent(LightweightRTObject_ptr comp) {
    return requestTransition(comp, INACTIVE_STATE, ACTIVE_STATE, m_activation);
}
ReturnCode_t ExecutionContextBase::deactivateComponent(LightweightRTObject_ptr comp) {
    return requestTransition(comp, ACTIVE_STATE, INACTIVE_STATE, m_deactivation);
}
ReturnCode_t ExecutionContextBase::resetComponent(LightweightRTObject_ptr comp) {
    return requestTransition(comp, ERROR_STATE, INACTIVE_STATE, m_reset);
}

ReturnCode_t ExecutionContextBase::requestTransition(LightweightRTObject_ptr comp, LifeCycleState from,
                                                     LifeCycleState to, const TransitionWait& wait) {
    Participant participant = find(comp);
    if (!participant) return BAD_PARAMETER;
    // Before start() the component is still being created. After stop() it has run onShutdown. onActivated belongs
    // between the two.
    if (to == ACTIVE_STATE && !isRunning()) return PRECONDITION_NOT_MET;
    // The same transition may already be pending, if it was requested in the last cycle. It is then carried out here.
    if (!participant->requestTransition(from, to) && !participant->isRequested(from, to))
        return PRECONDITION_NOT_MET;
    if (hasThread()) {
        onTransitionRequested();
        return !wait.sync || isInsideCycle() ? RTC_OK : waitForTransition(participant, to, wait.timeout);
    }
    if (isInsideCycle()) return RTC_OK; // carried out at the beginning of the next cycle
    // No thread runs cycles, so the transition is carried out here, between two cycles of other callers.
    std::unique_lock<std::timed_mutex> lock(m_cycleMutex, wait.timeout);
    if (!lock.owns_lock()) return RTC_ERROR;
    m_cycleThread = std::this_thread::get_id();
    participant->applyTransition();
    // A failed activation or reset leaves a second transition, to the ERROR state. It is carried out before the call
    // returns.
    if (participant->hasPendingTransition()) participant->applyTransition();
    m_cycleThread = std::thread::id();
    return participant->state() == to ? RTC_OK : RTC_ERROR;
}

ReturnCode_t ExecutionContextBase::waitForTransition(const Participant& participant, LifeCycleState to,
                                                     std::chrono::nanoseconds timeout) {
    // A transition needs a cycle, and a slow context begins one up to a period later. One minute is the limit for
    // contexts with periods of hours.
    const std::chrono::nanoseconds cycle_wait =
        std::min<std::chrono::nanoseconds>(2 * getPeriod(), std::chrono::minutes(1));
    const auto bound = timeout + cycle_wait;
    std::unique_lock<std::mutex> lock(m_cycleDoneMutex);
    // No cycle follows when the context stops. A tool that waits here must not keep the ORB from ending.
    m_cycleDone.wait_for(lock, bound, [&] { return !participant->hasPendingTransition() || !isRunning(); });
    return participant->state() == to && !participant->hasPendingTransition() ? RTC_OK : RTC_ERROR;
}

} // namespace RTC
