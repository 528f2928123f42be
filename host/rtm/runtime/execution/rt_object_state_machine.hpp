// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/process/published/component_states.hpp"
#include "host/process/published/notices.hpp"
#include <atomic>
#include <cstdint>
#include <optional>
#include <rtm/RTC.h>
#include <string>

namespace RTC {
class RTObject_impl;
}

namespace RTC_impl {

/// The life-cycle state machine of one component in one execution context (OMG RTC 1.0: INACTIVE, ACTIVE,
/// ERROR). A component of this process is called through its C++ object, any other by CORBA. state(),
/// hasPendingTransition(), requestTransition() and isRequested() [any-thread]; startup(), shutdown() and
/// rateChanged() in the thread that changes the context; the steps of the cycle in the thread that runs it.
class RTObjectStateMachine {
  public:
    /// `id` is the component's handle of the context. Throws CORBA::SystemException when a component of
    /// another process cannot be asked for its interface.
    RTObjectStateMachine(RTC::UniqueId id, RTC::LightweightRTObject_ptr component);
    ~RTObjectStateMachine();

    RTC::LifeCycleState state() const;
    bool hasPendingTransition() const;
    /// Returns whether a cycle has nothing to do.
    bool isInactive() const;
    /// Requests a transition, which the next applyTransition() carries out. Returns false if the component is not in
    /// state `from`, or if a transition is already pending.
    bool requestTransition(RTC::LifeCycleState from, RTC::LifeCycleState to);
    /// Returns whether exactly this transition is pending.
    bool isRequested(RTC::LifeCycleState from, RTC::LifeCycleState to) const;
    bool refersTo(RTC::LightweightRTObject_ptr component) const;
    /// Returns NULL if the component is in another process.
    const RTC::RTObject_impl* local() const { return local_; }
    /// Returns the name of the component; empty if it is in another process.
    const std::string& name() const { return name_; }
    /// The reference is not duplicated; it is valid as long as this object.
    RTC::LightweightRTObject_ptr reference() const { return reference_.in(); }

    // The steps of one cycle, in this order. In a rehearsal (host/rt/rehearsal.hpp) they call no function of the component and
    // change nothing.

    /// Carries out the pending transition. A transition that fails leads to the ERROR state. Returns false if none is pending.
    bool applyTransition();
    /// on_execute in the ACTIVE state, on_error in the ERROR state; nothing while a transition is pending.
    void execute();
    /// on_state_update in the ACTIVE state.
    void runStateUpdate();

    /// Reports what the three steps use (host/rt/cycle_lines.hpp).
    void note_lines() const;

    // Callbacks outside the cycle; their result is the component's, RTC_ERROR when it cannot be reached.
    RTC::ReturnCode_t startup();
    RTC::ReturnCode_t shutdown();
    RTC::ReturnCode_t rateChanged();

  private:
    /// One value, because a cycle looks at both several times. Aligned, because clang else calls libatomic to exchange them.
    struct alignas(std::uint64_t) States {
        RTC::LifeCycleState current, next; // they differ while a transition is pending
        bool operator==(const States&) const = default;
    };
    static_assert(std::atomic<States>::is_always_lock_free);
    struct Action;
    static const Action on_startup, on_shutdown, on_activated, on_deactivated, on_aborting, on_error,
        on_reset, on_execute, on_state_update, on_rate_changed;

    RTC::ReturnCode_t call(const Action& action);
    RTC::ReturnCode_t callRemote(const Action& action);
    RTC::ReturnCode_t executeComponent();
    void requestErrorState();
    void noteFailure();
    void publishState(RTC::LifeCycleState state);
    void enterState(RTC::LifeCycleState state, bool entered);

    // First what each cycle uses.
    std::atomic<States> states_{States{RTC::INACTIVE_STATE, RTC::INACTIVE_STATE}};
    RTC::UniqueId id_;
    RTC::RTObject_impl* local_; // NULL: of another process
    RTC::LightweightRTObject_var reference_;
    RTC::DataFlowComponentAction_var data_flow_actions_; // nil: of this process, or without these actions
    std::string name_;
    std::optional<tandem::process::OwnComponentState> published_; // of a component of this process
    std::string failure_;                                         // of the callback that has failed last
    std::optional<tandem::process::OwnNotice> reason_;            // in ERROR
};

} // namespace RTC_impl
