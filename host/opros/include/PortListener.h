// SPDX-License-Identifier: Apache-2.0
// Ours, for bridges.
#ifndef PORTLISTENER_H_
#define PORTLISTENER_H_

#include <Port.h>

#include <string>

/// Notified of each port that is added to a component or removed from it, after the change, in the thread that makes it.
class PortListener {
  public:
    virtual ~PortListener() {}
    /// [any-thread] Must not throw, nor add or remove listeners or ports of the same component.
    virtual void portAdded(const std::string& name, Port& port) = 0;
    /// The port stays in memory for those that still use it.
    virtual void portRemoved(const std::string& name, Port& port) = 0;
};

#endif
