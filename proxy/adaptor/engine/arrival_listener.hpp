// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifndef TANDEM_OPROS_PUBLIC_API
#include <DataPortListener.h>
#endif

namespace tandem::adaptor::engine {

#ifdef TANDEM_OPROS_PUBLIC_API
/// Told of messages that have arrived.
class ArrivalListener {
  public:
    virtual ~ArrivalListener() = default;
    /// [any-thread] Must not block, and must not throw.
    virtual void arrived() = 0;
};
#else
using ArrivalListener = ::DataPortListener;
#endif

} // namespace tandem::adaptor::engine
