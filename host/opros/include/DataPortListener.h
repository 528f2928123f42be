// SPDX-License-Identifier: Apache-2.0
// Ours, for the host.
#ifndef DATAPORTLISTENER_H_
#define DATAPORTLISTENER_H_

/// Notified of each value that is pushed into an input data port, in the thread that pushes it, after the value is in
/// the queue. Values that wait in a DataPortSource are not notified.
class DataPortListener {
  public:
    virtual ~DataPortListener() {}
    /// [any-thread] Must not block, and must not throw.
    virtual void arrived() = 0;
};

#endif
