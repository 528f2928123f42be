// SPDX-License-Identifier: Apache-2.0
// The life of a component:
//   CREATED -initialize-> READY -start-> ACTIVE -stop-> INACTIVE -start-> ACTIVE
//   ACTIVE -stopOnError-> ERROR -recover-> READY        any but CREATED -destroy-> DESTROYED
//   reset, from any state: onReset, onInitialize, onStart -> ACTIVE
// A call that asks for the state the component is in succeeds without doing anything; one that is not allowed in its
// state, or whose callback fails, returns OPROS_PRECONDITION_NOT_MET.
#ifndef LIFECYCLEINTERFACE_H_
#define LIFECYCLEINTERFACE_H_

#include <LifecycleListener.h>
#include <OPRoSTypes.h>
#include <ReturnType.h>

namespace opros {
namespace detail {
struct lifecycle_state;
}
} // namespace opros

/// The transitions are called by the host, and may be called by the component itself and by tools: [any-thread], one
/// at a time, each with its callback in the calling thread. What a callback throws passes through.
class LifecycleInterface {
  public:
    LifecycleInterface();
    virtual ~LifecycleInterface();

    virtual ReturnType initialize();
    virtual ReturnType start();
    virtual ReturnType stop();
    virtual ReturnType destroy();
    virtual ReturnType reset();
    /// An ACTIVE component is in ERROR when this returns, even when onError() fails; in any other state but ERROR it
    /// is OPROS_PRECONDITION_NOT_MET. Does not wait for a transition that is under way.
    virtual ReturnType stopOnError();
    virtual ReturnType recover();
    /// For the host, when the component cannot initialize or start: ERROR from any state, with onError() unless the
    /// state was CREATED, in which there is nothing to switch off (ours).
    ReturnType fail();

    /// The state when this was called; another thread may be changing it.
    virtual LifecycleState getStatus();
    /// The return code of the last callback that has failed; OPROS_SUCCESS when none has.
    virtual ReturnType getErrorInfo();
    /// [any-thread] The listener must be removed before it is deleted; on return of the removal it is not in use (ours).
    void addLifecycleListener(LifecycleListener* listener);
    void removeLifecycleListener(LifecycleListener* listener);

  protected:
    virtual ReturnType onInitialize() = 0;
    virtual ReturnType onStart() = 0;
    virtual ReturnType onStop() = 0;
    virtual ReturnType onDestroy() = 0;
    virtual ReturnType onReset() = 0;
    virtual ReturnType onError() = 0;
    virtual ReturnType onRecover() = 0;
    /// Called after a successful stop, when values that wait in the ports are out of date.
    virtual void afterStop() {}

  private:
    LifecycleInterface(const LifecycleInterface&);
    LifecycleInterface& operator=(const LifecycleInterface&);
    bool succeeded(ReturnType result);
    ReturnType enter(LifecycleState from, LifecycleState to);
    void changeState(LifecycleState to);
    void notifyListeners();

    // Not members: <mutex> and <atomic> would bring names of std that components define themselves.
    opros::detail::lifecycle_state* const m_lifecycle;
};

#endif
