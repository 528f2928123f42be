// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <mutex>
#include <rtm/RTC.h>

namespace RTC {
class RTObject_impl;
}

namespace RTC_impl {

/// The state machine of one component in one execution context. A component of this process is called through
/// its C++ object, another one by CORBA.
/// goTo() and state() are for any thread, the others for the thread that runs the context's cycle.
class RTObjectStateMachine {
  public:
    RTObjectStateMachine(RTC::UniqueId id, RTC::LightweightRTObject_ptr component);
    ~RTObjectStateMachine();

    RTC::LifeCycleState state() const;
    bool hasPendingTransition() const;
    /// Asks for a transition; false when the component is in another state than `from` or already on its way.
    bool goTo(RTC::LifeCycleState from, RTC::LifeCycleState to);
    bool onItsWay(RTC::LifeCycleState from, RTC::LifeCycleState to) const;

    bool refersTo(RTC::LightweightRTObject_ptr component) const;
    RTC::LightweightRTObject_ptr reference() const { return reference_.in(); }

    // A rehearsal goes the same way, so that code and data are in the caches, but calls nothing of the component
    // and changes nothing.

    /// Carries out a requested transition.
    void preDo(bool rehearsal = false);
    /// onExecute or onError.
    void execute(bool rehearsal);
    /// onStateUpdate.
    void postDo();

    RTC::ReturnCode_t startup();
    RTC::ReturnCode_t shutdown();
    RTC::ReturnCode_t rateChanged();

  private:
    enum class Action {
        startup,
        shutdown,
        activated,
        deactivated,
        aborting,
        error,
        reset,
        execute,
        rehearse,
        update,
        rate
    };
    RTC::ReturnCode_t call(Action action);
    RTC::ReturnCode_t callRemote(Action action);
    RTC::ReturnCode_t callLocal(Action action);
    void requestErrorState();

    RTC::UniqueId id_;
    RTC::LightweightRTObject_var reference_;
    RTC::DataFlowComponentAction_var remote_actions_;
    RTC::RTObject_impl* local_;
    mutable std::mutex mutex_;
    RTC::LifeCycleState current_ = RTC::INACTIVE_STATE;
    RTC::LifeCycleState next_ = RTC::INACTIVE_STATE;
};

} // namespace RTC_impl
