// SPDX-License-Identifier: Apache-2.0
// Ours, for the host.
#ifndef DATAPORTLISTENER_H_
#define DATAPORTLISTENER_H_

class DataPortListener;

/// A place to sleep that a source lends to a listener's thread: whoever sends values wakes that thread itself, with no other
/// thread in between.
class ArrivalWaiter {
  public:
    enum Result {
        REFUSED, ///< not now: another thread of the source calls arrived()
        WOKEN,   ///< by wake(), or for no reason
        ARRIVED  ///< values have come since the last time; arrived() is not called for them
    };
    virtual ~ArrivalWaiter() {}
    /// [the listener's thread] Sleeps until values have come or wake() is called; may return early.
    virtual Result wait(const DataPortListener& listener) = 0;
    /// [any-thread] Ends the listener's wait(): the one under way, or the next. Must not block.
    virtual void wake(const DataPortListener& listener) = 0;
};

/// Notified of each value that is pushed into an input data port, in the thread that pushes it, after the value is in
/// the queue. Values that wait in a DataPortSource are not notified.
class DataPortListener {
  public:
    virtual ~DataPortListener() {}
    /// [any-thread] Must not block, and must not throw.
    virtual void arrived() = 0;
    /// Lends the listener a waiter, until it is withdrawn. False: the listener makes no use of it.
    virtual bool offerWaiter(ArrivalWaiter* /*waiter*/) { return false; }
    /// [not the listener's thread in wait()] On return the waiter is not in use any more. Does nothing with one that the
    /// listener has not taken.
    virtual void withdrawWaiter(ArrivalWaiter* /*waiter*/) {}
};

#endif
