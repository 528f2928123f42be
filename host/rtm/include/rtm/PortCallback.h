// SPDX-License-Identifier: Apache-2.0
// Function objects that a component may set on a port, as in 1.x.
#ifndef RTC_PORTCALLBACK_H
#define RTC_PORTCALLBACK_H
#include <rtm/RTC.h>

namespace RTC {

/// Called at a step of a connection. May change the profile.
class ConnectionCallback {
  public:
    virtual ~ConnectionCallback() = default;
    virtual void operator()(RTC::ConnectorProfile& profile) = 0;
};

/// Called before a value is written. [writer's thread]
template <class DataType>
struct OnWrite {
    virtual ~OnWrite() = default;
    virtual void operator()(const DataType& value) = 0;
};
/// Returns the value to send instead of `value`. [writer's thread]
template <class DataType>
struct OnWriteConvert {
    virtual ~OnWriteConvert() = default;
    virtual DataType operator()(const DataType& value) = 0;
};
/// Called before a buffer is read. [reader's thread]
template <class DataType>
struct OnRead {
    virtual ~OnRead() = default;
    virtual void operator()() = 0;
};
/// Returns the value for the component instead of the value read. [reader's thread]
template <class DataType>
struct OnReadConvert {
    virtual ~OnReadConvert() = default;
    virtual DataType operator()(const DataType& value) = 0;
};

} // namespace RTC
#endif
