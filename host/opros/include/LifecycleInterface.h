// SPDX-License-Identifier: Apache-2.0
// The life of a component:
//   CREATED -initialize-> READY -start-> ACTIVE -stop-> INACTIVE -start-> ACTIVE
//   ACTIVE -stopOnError-> ERROR -recover-> READY        any but CREATED -destroy-> DESTROYED
//   reset, from any state: onReset, onInitialize, onStart -> ACTIVE
// A call that requests the current state succeeds without effect. A call that is not allowed in the current state, or
// whose callback fails, returns OPROS_PRECONDITION_NOT_MET.
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

/// Transitions of a component. The host, the component itself and tools may call them. They run one at a time, each
/// with its callback in the calling thread. Exceptions of a callback pass through. [any-thread]
class LifecycleInterface {
  public:
    LifecycleInterface();
    virtual ~LifecycleInterface();

    virtual ReturnType initialize();
    virtual ReturnType start();
    virtual ReturnType stop();
    virtual ReturnType destroy();
    virtual ReturnType reset();
    /// Puts an ACTIVE component in ERROR, even if onError() fails. Returns OPROS_PRECONDITION_NOT_MET in any other
    /// state except ERROR. Does not wait for a current transition.
    virtual ReturnType stopOnError();
    virtual ReturnType recover();
    /// Puts the component in ERROR from any state; the host calls it if the component cannot initialize or start. Calls
    /// onError() unless the state was CREATED, in which nothing needs to be switched off (ours).
    ReturnType fail();

    /// Returns the state at the time of the call; another thread may be changing it.
    virtual LifecycleState getStatus();
    /// Returns the code of the last failed callback, or OPROS_SUCCESS if none has failed.
    virtual ReturnType getErrorInfo();
    /// Adds a listener, which must be removed before it is deleted. On return from the removal it is not in use.
    /// [any-thread] (ours)
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
    /// Is called after a successful stop, when the values in the ports are outdated.
    virtual void afterStop() {}

  private:
    LifecycleInterface(const LifecycleInterface&);
    LifecycleInterface& operator=(const LifecycleInterface&);
    bool succeeded(ReturnType result);
    ReturnType enter(LifecycleState from, LifecycleState to);
    void changeState(LifecycleState to);
    void notifyListeners();

    // Not members: <mutex> and <atomic> would add names to std that components define themselves.
    opros::detail::lifecycle_state* const m_lifecycle;
};

#endif
