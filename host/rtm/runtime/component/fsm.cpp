// SPDX-License-Identifier: Apache-2.0
// What StaticFSM.h needs of the library: the queue of events of a component's state machine, and the calls of
// the listeners of its actions (FsmActionListener.h). The machine itself is in Macho.h.
#include <rtm/StaticFSM.h>

namespace RTC {

// Options of the connection's `buffer.*`; what cannot be read leaves the default.
void FsmEvents::init(const coil::Properties& buffer) {
    std::lock_guard<std::mutex> lock(m_mutex);
    std::size_t length = 0;
    if (coil::stringTo(length, buffer.getProperty("length").c_str()) && length > 0) m_length = length;
    const std::string policy = coil::normalize(buffer.getProperty("write.full_policy"));
    if (!policy.empty()) m_overwrite = policy == "overwrite";
}

// Returns false if the queue is full and its policy is not `overwrite`. That policy drops the oldest event instead.
bool FsmEvents::put(std::function<void()> event) {
    std::lock_guard<std::mutex> lock(m_mutex);
    if (m_events.size() >= m_length) {
        if (!m_overwrite) return false;
        m_events.pop_front();
    }
    m_events.push_back(std::move(event));
    return true;
}

// The event runs after this returns, outside the mutex, because an event may put others.
bool FsmEvents::take(std::function<void()>& event) {
    std::lock_guard<std::mutex> lock(m_mutex);
    if (m_events.empty()) return false;
    event = std::move(m_events.front());
    m_events.pop_front();
    return true;
}

std::size_t FsmEvents::readable() const {
    std::lock_guard<std::mutex> lock(m_mutex);
    return m_events.size();
}

// Defines preOnFsmNAME() and postOnFsmNAME(), which the states of a machine call around their actions.
#define TANDEM_FSM_ACTION(Name, NAME)                                                                        \
    void RTObject_impl::preOnFsm##Name(const char* state) {                                                  \
        m_fsmListeners.preaction_[static_cast<std::size_t>(PreFsmActionListenerType::PRE_ON_##NAME)]         \
            .forEach([&](auto& listener) { listener(state); });                                              \
    }                                                                                                        \
    void RTObject_impl::postOnFsm##Name(const char* state, ReturnCode_t ret) {                               \
        m_fsmListeners.postaction_[static_cast<std::size_t>(PostFsmActionListenerType::POST_ON_##NAME)]      \
            .forEach([&](auto& listener) { listener(state, ret); });                                         \
    }
TANDEM_FSM_ACTION(Init, INIT)
TANDEM_FSM_ACTION(Entry, ENTRY)
TANDEM_FSM_ACTION(Do, DO)
TANDEM_FSM_ACTION(Exit, EXIT)
TANDEM_FSM_ACTION(StateChange, STATE_CHANGE)

} // namespace RTC
