// SPDX-License-Identifier: Apache-2.0
// The life of a component:
//   CREATED -initialize-> READY -start-> ACTIVE -stop-> INACTIVE -start-> ACTIVE
//   ACTIVE -stopOnError-> ERROR -recover-> READY        any but CREATED -destroy-> DESTROYED
//   reset, from any state: onReset, onInitialize, onStart -> ACTIVE
// A call that asks for the state the component is in succeeds without doing anything; one that is not allowed in its
// state, or whose callback fails, returns OPROS_PRECONDITION_NOT_MET.
#ifndef LIFECYCLEINTERFACE_H_
#define LIFECYCLEINTERFACE_H_

#include <OPRoSTypes.h>
#include <ReturnType.h>

#include <atomic>
#include <mutex>

class LifecycleInterface {
  public:
    LifecycleInterface();
    virtual ~LifecycleInterface();

    virtual ReturnType initialize();
    virtual ReturnType start();
    virtual ReturnType stop();
    virtual ReturnType destroy();
    virtual ReturnType reset();
    /// [any-thread] The component is in ERROR when this returns, whatever onError() makes of it.
    virtual ReturnType stopOnError();
    virtual ReturnType recover();
    /// For the host: ERROR, whatever the state, and onError(), unless there is nothing to stop yet (CREATED): what
    /// cannot initialize or start takes no part (ours).
    ReturnType fail();

    /// [any-thread]
    virtual LifecycleState getStatus();
    /// What the last callback that failed has returned. [any-thread]
    virtual ReturnType getErrorInfo();

  protected:
    virtual ReturnType onInitialize() = 0;
    virtual ReturnType onStart() = 0;
    virtual ReturnType onStop() = 0;
    virtual ReturnType onDestroy() = 0;
    virtual ReturnType onReset() = 0;
    virtual ReturnType onError() = 0;
    virtual ReturnType onRecover() = 0;
    /// After a successful stop: what waits in the ports is of no use any more.
    virtual void afterStop() {}

  private:
    LifecycleInterface(const LifecycleInterface&);
    LifecycleInterface& operator=(const LifecycleInterface&);
    bool succeeded(ReturnType result);
    ReturnType enter(LifecycleState from, LifecycleState to);

    std::atomic<LifecycleState> m_state;
    std::atomic<ReturnType> m_error;
    // One transition at a time; recursive because callbacks may ask for transitions. stopOnError() goes without it,
    // since onStop() may wait for the thread that reports the error.
    std::recursive_mutex m_transition;
};

#endif
