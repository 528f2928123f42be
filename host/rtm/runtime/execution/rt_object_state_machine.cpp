// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/execution/rt_object_state_machine.hpp"
#include "host/rt/cycle_lines.hpp"
#include "host/rt/rehearsal.hpp"
#include "host/rtm/runtime/execution/callback_failure.hpp"
#include "host/rtm/runtime/manager/slow_transitions.hpp"
#include "host/rtm/runtime/naming/local_object.hpp"
#include <rtm/RTObject.h>
#include <type_traits>

namespace RTC_impl {

using RTC::ACTIVE_STATE;
using RTC::ERROR_STATE;
using RTC::INACTIVE_STATE;
using RTC::LifeCycleState;
using RTC::RTC_OK;
using tandem::process::ComponentState;
using tandem::rt::rehearsing;

namespace {

// The classes of omniORB's stubs, which the IDL mapping names only by their pointers.
using ComponentStub = std::remove_pointer_t<RTC::ComponentAction_ptr>;
using DataFlowStub = std::remove_pointer_t<RTC::DataFlowComponentAction_ptr>;

} // namespace

/// One callback of a component and the ways to call it. `local` is for a component of this process. For another
/// process, one of the two pointers is set, for the IDL interface that declares the callback; the other is NULL.
struct RTObjectStateMachine::Action {
    RTC::ReturnCode_t (RTC::RTObject_impl::*local)(RTC::UniqueId);
    RTC::ReturnCode_t (ComponentStub::*remote)(RTC::UniqueId);
    RTC::ReturnCode_t (DataFlowStub::*remote_data_flow)(RTC::UniqueId);
};

#define TANDEM_COMPONENT_ACTION(NAME)                                                                        \
    const RTObjectStateMachine::Action RTObjectStateMachine::NAME{&RTC::RTObject_impl::NAME,                 \
                                                                  &ComponentStub::NAME, nullptr};
#define TANDEM_DATA_FLOW_ACTION(NAME)                                                                        \
    const RTObjectStateMachine::Action RTObjectStateMachine::NAME{&RTC::RTObject_impl::NAME, nullptr,        \
                                                                  &DataFlowStub::NAME};
TANDEM_COMPONENT_ACTION(on_startup)
TANDEM_COMPONENT_ACTION(on_shutdown)
TANDEM_COMPONENT_ACTION(on_activated)
TANDEM_COMPONENT_ACTION(on_deactivated)
TANDEM_COMPONENT_ACTION(on_aborting)
TANDEM_COMPONENT_ACTION(on_error)
TANDEM_COMPONENT_ACTION(on_reset)
TANDEM_DATA_FLOW_ACTION(on_execute)
TANDEM_DATA_FLOW_ACTION(on_state_update)
TANDEM_DATA_FLOW_ACTION(on_rate_changed)
#undef TANDEM_COMPONENT_ACTION
#undef TANDEM_DATA_FLOW_ACTION

RTObjectStateMachine::RTObjectStateMachine(RTC::UniqueId id, RTC::LightweightRTObject_ptr component)
    : id_(id), local_(RTC::local_object<RTC::RTObject_impl>(component).get()),
      reference_(RTC::LightweightRTObject::_duplicate(component)) {
    if (local_ == nullptr)
        data_flow_actions_ = RTC::DataFlowComponentAction::_narrow(component);
    else
        published_.emplace(name_ = local_->getInstanceName(), ComponentState::inactive);
}

RTObjectStateMachine::~RTObjectStateMachine() = default;

LifeCycleState RTObjectStateMachine::state() const { return states_.load().current; }

bool RTObjectStateMachine::hasPendingTransition() const {
    const States now = states_;
    return now.current != now.next;
}

bool RTObjectStateMachine::isInactive() const {
    return states_.load() == States{INACTIVE_STATE, INACTIVE_STATE};
}

bool RTObjectStateMachine::requestTransition(LifeCycleState from, LifeCycleState to) {
    States expected{from, from};
    return states_.compare_exchange_strong(expected, {from, to});
}

bool RTObjectStateMachine::isRequested(LifeCycleState from, LifeCycleState to) const {
    return states_.load() == States{from, to};
}

bool RTObjectStateMachine::refersTo(RTC::LightweightRTObject_ptr component) const {
    return reference_->_is_equivalent(component);
}

// Overrides a pending transition, because an error has priority.
void RTObjectStateMachine::requestErrorState() {
    States now = states_;
    while (!states_.compare_exchange_weak(now, {now.current, ERROR_STATE})) continue;
}

void RTObjectStateMachine::noteFailure() {
    if (local_ != nullptr) failure_ = RTC::take_callback_failure(local_);
}

// Shows the state to other processes (host/process/published). Publishes the reason before it, so that an observer that sees the
// state sees the reason, too.
void RTObjectStateMachine::publishState(LifeCycleState state) {
    if (state == ERROR_STATE && !failure_.empty())
        reason_.emplace(tandem::process::NoticeKind::component, name_ + ": " + failure_);
    published_->set(state == ACTIVE_STATE  ? ComponentState::active
                    : state == ERROR_STATE ? ComponentState::error
                                           : ComponentState::inactive);
    if (state != ERROR_STATE) reason_.reset();
}

// Ends a transition. If on_activated has failed, the component counts as active until the next step aborts it.
void RTObjectStateMachine::enterState(LifeCycleState state, bool entered) {
    if (published_) publishState(state);
    // An error that was requested meanwhile stays pending.
    States now = states_;
    while (!states_.compare_exchange_weak(now, {state, entered ? now.next : ERROR_STATE})) continue;
}

bool RTObjectStateMachine::applyTransition() {
    const auto [from, to] = states_.load();
    if (from == to || rehearsing()) return false;
    const RTC::TransitionScope scope;
    // The callbacks may ask for the state, or request a transition.
    if (from == ACTIVE_STATE) call(on_deactivated);
    if (from == ERROR_STATE && call(on_reset) != RTC_OK) { // it stays in ERROR
        requestErrorState();
        return true;
    }
    const bool entered = to == ACTIVE_STATE ? call(on_activated) == RTC_OK : true;
    if (!entered) noteFailure();
    if (to == ERROR_STATE) call(on_aborting);
    enterState(to, entered);
    return true;
}

void RTObjectStateMachine::note_lines() const {
    tandem::rt::note_lines(&states_, sizeof states_ + sizeof id_ + sizeof(void*));
}

void RTObjectStateMachine::execute() {
    const auto [now, next] = states_.load();
    if (now != next) return;
    if (now == ERROR_STATE && !rehearsing()) call(on_error);
    if (now == ACTIVE_STATE && executeComponent() != RTC_OK) {
        noteFailure();
        requestErrorState();
    }
}

void RTObjectStateMachine::runStateUpdate() {
    if (states_.load() == States{ACTIVE_STATE, ACTIVE_STATE} && call(on_state_update) != RTC_OK) {
        noteFailure();
        requestErrorState();
    }
}

RTC::ReturnCode_t RTObjectStateMachine::startup() {
    const RTC::TransitionScope scope;
    return call(on_startup);
}
RTC::ReturnCode_t RTObjectStateMachine::shutdown() {
    const RTC::TransitionScope scope;
    return call(on_shutdown);
}
RTC::ReturnCode_t RTObjectStateMachine::rateChanged() { return call(on_rate_changed); }

RTC::ReturnCode_t RTObjectStateMachine::call(const Action& action) {
    return local_ ? (local_->*action.local)(id_) : callRemote(action);
}

RTC::ReturnCode_t RTObjectStateMachine::callRemote(const Action& action) {
    try {
        if (action.remote != nullptr) {
            RTC::ComponentAction_ptr actions = reference_.in();
            return (actions->*action.remote)(id_);
        }
        // A component without data-flow actions (a plain LightweightRTObject) does nothing here.
        if (CORBA::is_nil(data_flow_actions_.in())) return RTC_OK;
        return (data_flow_actions_.in()->*action.remote_data_flow)(id_);
    } catch (const CORBA::SystemException&) {
        return RTC::RTC_ERROR; // a component that cannot be reached is in error
    }
}

// Only a component of this process has code and data here that a rehearsal could load into the caches. A rehearsal does
// not call the on_execute() of a derived class, which may have effects. The table of actions is not used, because its
// cache line would be missing in the first cycle after a rehearsal.
RTC::ReturnCode_t RTObjectStateMachine::executeComponent() {
    if (local_ == nullptr) return rehearsing() ? RTC_OK : callRemote(on_execute);
    return rehearsing() ? local_->RTObject_impl::on_execute(id_) : local_->on_execute(id_);
}

} // namespace RTC_impl
