// SPDX-License-Identifier: Apache-2.0
// Ours, for bridges.
#ifndef PORTLISTENER_H_
#define PORTLISTENER_H_

#include <Port.h>

#include <string>

/// Is notified of each port that is added to or removed from a component, after the change, in the thread that makes
/// it.
class PortListener {
  public:
    virtual ~PortListener() {}
    /// Must not throw, and must not add or remove listeners or ports of the same component. [any-thread]
    virtual void portAdded(const std::string& name, Port& port) = 0;
    /// The port remains in memory for current users.
    virtual void portRemoved(const std::string& name, Port& port) = 0;
};

#endif
