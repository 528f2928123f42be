// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifndef TANDEM_OPROS_PUBLIC_API
#include <DataPortListener.h>
#endif

namespace tandem::adaptor::engine {

#ifdef TANDEM_OPROS_PUBLIC_API
class ArrivalListener;

/// A place where the thread of a listener could sleep. In this engine no thread does.
class ArrivalWaiter {
  public:
    enum Result { REFUSED, WOKEN, ARRIVED };
    virtual ~ArrivalWaiter() = default;
    virtual Result wait(const ArrivalListener&) = 0;
    virtual void wake(const ArrivalListener&) = 0;
};

/// Notified of messages that have arrived.
class ArrivalListener {
  public:
    virtual ~ArrivalListener() = default;
    /// [any-thread] Must not block, and must not throw.
    virtual void arrived() = 0;
    bool offerWaiter(ArrivalWaiter*) { return false; }
    void withdrawWaiter(ArrivalWaiter*) {}
};
#else
using ArrivalListener = ::DataPortListener;
using ArrivalWaiter = ::ArrivalWaiter;
#endif

} // namespace tandem::adaptor::engine
