// SPDX-License-Identifier: Apache-2.0
// The cycle of an execution context, and how requested transitions get done.
#include "host/rtm/runtime/execution/rt_object_state_machine.hpp"
#include <algorithm>
#include <rtm/ExecutionContextBase.h>

namespace RTC {

bool ExecutionContextBase::isInsideCycle() const {
    return m_cycleThread.load() == std::this_thread::get_id();
}

void ExecutionContextBase::invokeWorker() {
    cycle(false);
    { std::lock_guard<std::mutex> lock(m_cycleDoneMutex); }
    m_cycleDone.notify_all();
}

void ExecutionContextBase::warmUp() { cycle(true); }

void ExecutionContextBase::cycle(bool warm_up) {
    std::lock_guard<std::timed_mutex> lock(m_cycleMutex);
    m_cycleThread = std::this_thread::get_id();
    const auto all = participants();
    for (auto& participant : *all) participant->applyTransition(warm_up);
    for (auto& participant : *all) participant->execute(warm_up);
    if (!warm_up)
        for (auto& participant : *all) participant->updateState();
    m_cycleThread = std::thread::id();
}

bool ExecutionContextBase::hasWork() {
    for (auto& participant : *participants())
        if (participant->hasPendingTransition() || participant->state() != INACTIVE_STATE) return true;
    return false;
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
    // Its component is still being created, or was stopped for good: onActivated belongs between start and
    // stop.
    if (to == ACTIVE_STATE && !isRunning()) return PRECONDITION_NOT_MET;
    // Asked for already in a callback of a context whose cycles are over: that is done now.
    if (!participant->requestTransition(from, to) && !participant->isRequested(from, to))
        return PRECONDITION_NOT_MET;
    if (hasThread()) {
        onTransitionRequested();
        return !wait.sync || isInsideCycle() ? RTC_OK : waitForTransition(participant, to, wait.timeout);
    }
    if (isInsideCycle()) return RTC_OK; // done at the beginning of the next cycle
    std::unique_lock<std::timed_mutex> lock(m_cycleMutex, wait.timeout);
    if (!lock.owns_lock()) return RTC_ERROR;
    m_cycleThread = std::this_thread::get_id();
    participant->applyTransition();
    // A component that cannot be activated, or not be reset, is to be in the error state when the call
    // returns.
    if (participant->hasPendingTransition()) participant->applyTransition();
    m_cycleThread = std::thread::id();
    return participant->state() == to ? RTC_OK : RTC_ERROR;
}

ReturnCode_t ExecutionContextBase::waitForTransition(const Participant& participant, LifeCycleState to,
                                                     std::chrono::nanoseconds timeout) {
    // A slow context cannot be expected to be done before its next cycle; but nobody waits for days.
    const std::chrono::nanoseconds cycle_wait =
        std::min<std::chrono::nanoseconds>(2 * getPeriod(), std::chrono::minutes(1));
    const auto bound = timeout + cycle_wait;
    std::unique_lock<std::mutex> lock(m_cycleDoneMutex);
    m_cycleDone.wait_for(lock, bound, [&] { return !participant->hasPendingTransition(); });
    return participant->state() == to && !participant->hasPendingTransition() ? RTC_OK : RTC_ERROR;
}

} // namespace RTC
