// SPDX-License-Identifier: Apache-2.0
// Ours, for bridges.
#ifndef LIFECYCLELISTENER_H_
#define LIFECYCLELISTENER_H_

#include <OPRoSTypes.h>

/// Is notified of each change of a component's state, after the change, in the thread that made it.
class LifecycleListener {
  public:
    virtual ~LifecycleListener() {}
    /// Must not block, throw, or add or remove listeners. `state` is the new state. If two changes coincide, the
    /// older may be notified last; ask for the state again to be sure. [any-thread]
    virtual void stateChanged(LifecycleState state) = 0;
};

#endif
