// SPDX-License-Identifier: Apache-2.0
#include "host/rt/cycle_lines.hpp"

#include <LifecycleInterface.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

struct opros::detail::lifecycle_state {
    std::atomic<LifecycleState> state{OPROS_CS_CREATED};
    std::atomic<ReturnType> error{OPROS_SUCCESS};
    // Allows one transition at a time. Recursive because callbacks may ask for transitions. stopOnError() does not
    // lock it, because onStop() may wait for the thread that reports the error.
    std::recursive_mutex transition;
    std::mutex listeners_mutex; // guards listeners; held while they are called
    std::vector<LifecycleListener*> listeners;
};

namespace {
/// Locks during a transition and its callback. Recursive: a callback may ask for another transition.
typedef std::lock_guard<std::recursive_mutex> Transition;
} // namespace

LifecycleInterface::LifecycleInterface() : m_lifecycle(new opros::detail::lifecycle_state) {}
LifecycleInterface::~LifecycleInterface() { delete m_lifecycle; }

LifecycleState LifecycleInterface::getStatus() {
    tandem::rt::note_lines(m_lifecycle, sizeof m_lifecycle->state); // each cycle reads the state
    return m_lifecycle->state.load();
}
ReturnType LifecycleInterface::getErrorInfo() { return m_lifecycle->error.load(); }

/// Returns false if a callback has failed, and stores its code for getErrorInfo().
bool LifecycleInterface::succeeded(ReturnType result) {
    if (result == OPROS_SUCCESS) return true;
    m_lifecycle->error = result;
    return false;
}

void LifecycleInterface::addLifecycleListener(LifecycleListener* listener) {
    const std::lock_guard<std::mutex> lock(m_lifecycle->listeners_mutex);
    m_lifecycle->listeners.push_back(listener);
}

void LifecycleInterface::removeLifecycleListener(LifecycleListener* listener) {
    const std::lock_guard<std::mutex> lock(m_lifecycle->listeners_mutex);
    auto& all = m_lifecycle->listeners;
    all.erase(std::remove(all.begin(), all.end(), listener), all.end());
}

void LifecycleInterface::notifyListeners() {
    const std::lock_guard<std::mutex> lock(m_lifecycle->listeners_mutex);
    for (LifecycleListener* listener : m_lifecycle->listeners)
        listener->stateChanged(m_lifecycle->state.load());
}

void LifecycleInterface::changeState(LifecycleState to) {
    m_lifecycle->state = to;
    notifyListeners();
}

/// Completes a transition, unless the state has changed during its callback. Another thread may have put the
/// component in ERROR with stopOnError(), and a late success must not hide the error.
ReturnType LifecycleInterface::enter(LifecycleState from, LifecycleState to) {
    if (!m_lifecycle->state.compare_exchange_strong(from, to)) return OPROS_PRECONDITION_NOT_MET;
    notifyListeners();
    return OPROS_SUCCESS;
}

ReturnType LifecycleInterface::initialize() {
    const Transition lock(m_lifecycle->transition);
    if (m_lifecycle->state == OPROS_CS_READY) return OPROS_SUCCESS;
    if (m_lifecycle->state != OPROS_CS_CREATED || !succeeded(onInitialize()))
        return OPROS_PRECONDITION_NOT_MET;
    return enter(OPROS_CS_CREATED, OPROS_CS_READY);
}

ReturnType LifecycleInterface::start() {
    const Transition lock(m_lifecycle->transition);
    const LifecycleState before = m_lifecycle->state;
    if (before == OPROS_CS_ACTIVE) return OPROS_SUCCESS;
    if (before != OPROS_CS_READY && before != OPROS_CS_INACTIVE) return OPROS_PRECONDITION_NOT_MET;
    if (!succeeded(onStart())) return OPROS_PRECONDITION_NOT_MET;
    return enter(before, OPROS_CS_ACTIVE);
}

ReturnType LifecycleInterface::stop() {
    const Transition lock(m_lifecycle->transition);
    if (m_lifecycle->state == OPROS_CS_INACTIVE) return OPROS_SUCCESS;
    if (m_lifecycle->state != OPROS_CS_ACTIVE || !succeeded(onStop())) return OPROS_PRECONDITION_NOT_MET;
    const ReturnType result = enter(OPROS_CS_ACTIVE, OPROS_CS_INACTIVE);
    if (result == OPROS_SUCCESS) afterStop();
    return result;
}

// Allowed from ERROR as well: an initialized component must be able to release its device.
ReturnType LifecycleInterface::destroy() {
    const Transition lock(m_lifecycle->transition);
    const LifecycleState before = m_lifecycle->state;
    if (before == OPROS_CS_DESTROYED) return OPROS_SUCCESS;
    if (before == OPROS_CS_CREATED || !succeeded(onDestroy())) return OPROS_PRECONDITION_NOT_MET;
    changeState(OPROS_CS_DESTROYED);
    return OPROS_SUCCESS;
}

// Calls the three callbacks one after the other in any state, as LifecycleInterface.h specifies.
ReturnType LifecycleInterface::reset() {
    const Transition lock(m_lifecycle->transition);
    if (!succeeded(onReset()) || !succeeded(onInitialize()) || !succeeded(onStart()))
        return OPROS_PRECONDITION_NOT_MET;
    changeState(OPROS_CS_ACTIVE);
    return OPROS_SUCCESS;
}

// Takes no lock: onStop(), which runs with the lock held, may wait for the calling thread. The exchange ensures that
// only one of several threads calls onError().
ReturnType LifecycleInterface::stopOnError() {
    if (m_lifecycle->state == OPROS_CS_ERROR) return OPROS_SUCCESS;
    if (enter(OPROS_CS_ACTIVE, OPROS_CS_ERROR) != OPROS_SUCCESS) return OPROS_PRECONDITION_NOT_MET;
    return succeeded(onError()) ? OPROS_SUCCESS : OPROS_PRECONDITION_NOT_MET;
}

ReturnType LifecycleInterface::fail() {
    // A component in CREATED has nothing that onError() could switch off, and its onError() may not expect a call.
    const LifecycleState before = m_lifecycle->state.exchange(OPROS_CS_ERROR);
    if (before != OPROS_CS_ERROR) notifyListeners();
    if (before == OPROS_CS_ERROR || before == OPROS_CS_CREATED) return OPROS_SUCCESS;
    return succeeded(onError()) ? OPROS_SUCCESS : OPROS_PRECONDITION_NOT_MET;
}

ReturnType LifecycleInterface::recover() {
    const Transition lock(m_lifecycle->transition);
    if (m_lifecycle->state == OPROS_CS_READY) return OPROS_SUCCESS;
    if (m_lifecycle->state != OPROS_CS_ERROR || !succeeded(onRecover())) return OPROS_PRECONDITION_NOT_MET;
    return enter(OPROS_CS_ERROR, OPROS_CS_READY);
}
