// SPDX-License-Identifier: Apache-2.0
// Ours, for bridges.
#ifndef LIFECYCLELISTENER_H_
#define LIFECYCLELISTENER_H_

#include <OPRoSTypes.h>

/// Notified of each change of a component's state, after the change, in the thread that has made it.
class LifecycleListener {
  public:
    virtual ~LifecycleListener() {}
    /// [any-thread] Must not block, throw, or add or remove listeners. `state` is the new one; of two changes at the
    /// same time the older may be notified last, so that a listener had better ask for the state again.
    virtual void stateChanged(LifecycleState state) = 0;
};

#endif
