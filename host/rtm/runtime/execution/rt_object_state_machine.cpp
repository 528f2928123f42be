#include "host/rtm/runtime/execution/rt_object_state_machine.hpp"
#include "host/rtm/runtime/component/local_object.hpp"
#include <rtm/RTObject.h>

namespace RTC_impl {

using RTC::ACTIVE_STATE;
using RTC::ERROR_STATE;
using RTC::LifeCycleState;
using RTC::RTC_OK;

RTObjectStateMachine::RTObjectStateMachine(RTC::UniqueId id, RTC::LightweightRTObject_ptr component)
    : id_(id), reference_(RTC::LightweightRTObject::_duplicate(component)),
      local_(RTC::local_object<RTC::RTObject_impl>(component).get()) {
    if (local_ == nullptr) remote_actions_ = RTC::DataFlowComponentAction::_narrow(component);
}

RTObjectStateMachine::~RTObjectStateMachine() = default;

LifeCycleState RTObjectStateMachine::state() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return current_;
}

bool RTObjectStateMachine::hasPendingTransition() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return current_ != next_;
}

bool RTObjectStateMachine::goTo(LifeCycleState from, LifeCycleState to) {
    std::lock_guard<std::mutex> lock(mutex_);
    if (current_ != from || next_ != from) return false;
    next_ = to;
    return true;
}

bool RTObjectStateMachine::onItsWay(LifeCycleState from, LifeCycleState to) const {
    std::lock_guard<std::mutex> lock(mutex_);
    return current_ == from && next_ == to;
}

bool RTObjectStateMachine::refersTo(RTC::LightweightRTObject_ptr component) const {
    return reference_->_is_equivalent(component);
}

void RTObjectStateMachine::requestErrorState() {
    std::lock_guard<std::mutex> lock(mutex_);
    next_ = ERROR_STATE;
}

void RTObjectStateMachine::preDo(bool rehearsal) {
    LifeCycleState from, to;
    {
        std::lock_guard<std::mutex> lock(mutex_);
        from = current_;
        to = next_;
    }
    if (from == to || rehearsal) return;
    if (from == ACTIVE_STATE) call(Action::deactivated);
    if (from == ERROR_STATE && call(Action::reset) != RTC_OK)
        return requestErrorState(); // stays in the error state
    const bool ok = to == ACTIVE_STATE ? call(Action::activated) == RTC_OK : true;
    if (to == ERROR_STATE) call(Action::aborting);
    std::lock_guard<std::mutex> lock(mutex_);
    current_ = to;
    if (!ok) next_ = ERROR_STATE;
}

void RTObjectStateMachine::execute(bool rehearsal) {
    if (hasPendingTransition()) return;
    const LifeCycleState now = state();
    if (now == ERROR_STATE && !rehearsal) call(Action::error);
    if (now == ACTIVE_STATE && call(rehearsal ? Action::rehearse : Action::execute) != RTC_OK)
        requestErrorState();
}

void RTObjectStateMachine::postDo() {
    if (!hasPendingTransition() && state() == ACTIVE_STATE && call(Action::update) != RTC_OK)
        requestErrorState();
}

RTC::ReturnCode_t RTObjectStateMachine::startup() { return call(Action::startup); }
RTC::ReturnCode_t RTObjectStateMachine::shutdown() { return call(Action::shutdown); }
RTC::ReturnCode_t RTObjectStateMachine::rateChanged() { return call(Action::rate); }

RTC::ReturnCode_t RTObjectStateMachine::call(Action action) {
    return local_ ? callLocal(action) : callRemote(action);
}

RTC::ReturnCode_t RTObjectStateMachine::callLocal(Action action) {
    switch (action) {
    case Action::startup:
        return local_->on_startup(id_);
    case Action::shutdown:
        return local_->on_shutdown(id_);
    case Action::activated:
        return local_->on_activated(id_);
    case Action::deactivated:
        return local_->on_deactivated(id_);
    case Action::aborting:
        return local_->on_aborting(id_);
    case Action::error:
        return local_->on_error(id_);
    case Action::reset:
        return local_->on_reset(id_);
    case Action::execute:
        return local_->on_execute(id_);
    case Action::rehearse:
        return local_->execute(id_, true);
    case Action::update:
        return local_->on_state_update(id_);
    case Action::rate:
        return local_->on_rate_changed(id_);
    }
    return RTC::BAD_PARAMETER;
}

RTC::ReturnCode_t RTObjectStateMachine::callRemote(Action action) {
    try {
        const bool data_flow = !CORBA::is_nil(remote_actions_.in());
        switch (action) {
        case Action::startup:
            return reference_->on_startup(id_);
        case Action::shutdown:
            return reference_->on_shutdown(id_);
        case Action::activated:
            return reference_->on_activated(id_);
        case Action::deactivated:
            return reference_->on_deactivated(id_);
        case Action::aborting:
            return reference_->on_aborting(id_);
        case Action::error:
            return reference_->on_error(id_);
        case Action::reset:
            return reference_->on_reset(id_);
        case Action::execute:
            return data_flow ? remote_actions_->on_execute(id_) : RTC_OK;
        case Action::rehearse:
            return RTC_OK;
        case Action::update:
            return data_flow ? remote_actions_->on_state_update(id_) : RTC_OK;
        case Action::rate:
            return data_flow ? remote_actions_->on_rate_changed(id_) : RTC_OK;
        }
    } catch (const CORBA::SystemException&) {
        return RTC::RTC_ERROR; // a component that cannot be reached is in error
    }
    return RTC::BAD_PARAMETER;
}

} // namespace RTC_impl
