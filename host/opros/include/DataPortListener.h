// SPDX-License-Identifier: Apache-2.0
// Ours, for the host.
#ifndef DATAPORTLISTENER_H_
#define DATAPORTLISTENER_H_

class DataPortListener;

/// A place to sleep that a source lends to the listener's thread. The sender of values wakes that thread directly,
/// without an intermediate thread.
class ArrivalWaiter {
  public:
    enum Result {
        REFUSED, ///< not now: another thread of the source calls arrived()
        WOKEN,   ///< by wake(), or for no reason
        ARRIVED  ///< values have come since the last time; arrived() is not called for them
    };
    virtual ~ArrivalWaiter() {}
    /// Sleeps until values have arrived or wake() is called. May return early. [listener's thread]
    virtual Result wait(const DataPortListener& listener) = 0;
    /// Ends the listener's current or next wait(). Must not block. [any-thread]
    virtual void wake(const DataPortListener& listener) = 0;
};

/// Is notified of each value that is pushed into an input data port, in the pushing thread, after the value is in the
/// queue. Is not notified of values that wait in a DataPortSource.
class DataPortListener {
  public:
    virtual ~DataPortListener() {}
    /// Must not block and must not throw. [any-thread]
    virtual void arrived() = 0;
    /// Lends the listener a waiter until withdrawWaiter(). Returns false if the listener does not use it.
    virtual bool offerWaiter(ArrivalWaiter* /*waiter*/) { return false; }
    /// Takes the waiter back; on return it is no longer in use. Ignores a waiter that the listener has not accepted.
    /// Must not be called by the listener's thread in wait().
    virtual void withdrawWaiter(ArrivalWaiter* /*waiter*/) {}
};

#endif
