// SPDX-License-Identifier: Apache-2.0
// The cycle of an execution context, and how requested transitions get done.
#include "host/rtm/runtime/execution/rt_object_state_machine.hpp"
#include <algorithm>
#include <rtm/ExecutionContextBase.h>

namespace RTC {

bool ExecutionContextBase::insideCycle() const { return m_cycling.load() == std::this_thread::get_id(); }

void ExecutionContextBase::invokeWorker() {
    cycle(false);
    { std::lock_guard<std::mutex> lock(m_changedMutex); }
    m_changed.notify_all();
}

void ExecutionContextBase::rehearse() { cycle(true); }

void ExecutionContextBase::cycle(bool rehearsal) {
    std::lock_guard<std::timed_mutex> lock(m_cycle);
    m_cycling = std::this_thread::get_id();
    const auto all = participants();
    for (auto& participant : *all) participant->preDo(rehearsal);
    for (auto& participant : *all) participant->execute(rehearsal);
    if (!rehearsal)
        for (auto& participant : *all) participant->postDo();
    m_cycling = std::thread::id();
}

bool ExecutionContextBase::busy() {
    for (auto& participant : *participants())
        if (participant->pending() || participant->state() != INACTIVE_STATE) return true;
    return false;
}

ReturnCode_t ExecutionContextBase::activateComponent(LightweightRTObject_ptr comp) {
    return transit(comp, INACTIVE_STATE, ACTIVE_STATE, m_activation);
}
ReturnCode_t ExecutionContextBase::deactivateComponent(LightweightRTObject_ptr comp) {
    return transit(comp, ACTIVE_STATE, INACTIVE_STATE, m_deactivation);
}
ReturnCode_t ExecutionContextBase::resetComponent(LightweightRTObject_ptr comp) {
    return transit(comp, ERROR_STATE, INACTIVE_STATE, m_reset);
}

ReturnCode_t ExecutionContextBase::transit(LightweightRTObject_ptr comp, LifeCycleState from,
                                           LifeCycleState to, const Wait& wait) {
    Participant participant = find(comp);
    if (!participant) return BAD_PARAMETER;
    // Its component is still being created, or was stopped for good: onActivated belongs between start and
    // stop.
    if (to == ACTIVE_STATE && !isRunning()) return PRECONDITION_NOT_MET;
    // Asked for already in a callback of a context whose cycles are over: that is done now.
    if (!participant->goTo(from, to) && !participant->onItsWay(from, to)) return PRECONDITION_NOT_MET;
    if (hasThread()) {
        onRequest();
        return !wait.sync || insideCycle() ? RTC_OK : await(participant, to, wait.timeout);
    }
    if (insideCycle()) return RTC_OK; // done at the beginning of the next cycle
    std::unique_lock<std::timed_mutex> lock(m_cycle, wait.timeout);
    if (!lock.owns_lock()) return RTC_ERROR;
    m_cycling = std::this_thread::get_id();
    participant->preDo();
    // A component that cannot be activated, or not be reset, is to be in the error state when the call
    // returns.
    if (participant->pending()) participant->preDo();
    m_cycling = std::thread::id();
    return participant->state() == to ? RTC_OK : RTC_ERROR;
}

ReturnCode_t ExecutionContextBase::await(const Participant& participant, LifeCycleState to,
                                         std::chrono::nanoseconds timeout) {
    // A slow context cannot be expected to be done before its next cycle; but nobody waits for days.
    const std::chrono::nanoseconds patience =
        std::min<std::chrono::nanoseconds>(2 * getPeriod(), std::chrono::minutes(1));
    const auto bound = timeout + patience;
    std::unique_lock<std::mutex> lock(m_changedMutex);
    m_changed.wait_for(lock, bound, [&] { return !participant->pending(); });
    return participant->state() == to && !participant->pending() ? RTC_OK : RTC_ERROR;
}

} // namespace RTC
