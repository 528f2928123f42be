// SPDX-License-Identifier: Apache-2.0
// Function objects a component may hang on a port.
#ifndef RTC_PORTCALLBACK_H
#define RTC_PORTCALLBACK_H
#include <rtm/RTC.h>

namespace RTC {

class ConnectionCallback {
  public:
    virtual ~ConnectionCallback() = default;
    virtual void operator()(RTC::ConnectorProfile& profile) = 0;
};

/// Before a value is written.
template <class DataType>
struct OnWrite {
    virtual ~OnWrite() = default;
    virtual void operator()(const DataType& value) = 0;
};
/// Changes the value that is sent.
template <class DataType>
struct OnWriteConvert {
    virtual ~OnWriteConvert() = default;
    virtual DataType operator()(const DataType& value) = 0;
};
/// Before a buffer is read.
template <class DataType>
struct OnRead {
    virtual ~OnRead() = default;
    virtual void operator()() = 0;
};
/// Changes the value that was read.
template <class DataType>
struct OnReadConvert {
    virtual ~OnReadConvert() = default;
    virtual DataType operator()(const DataType& value) = 0;
};

} // namespace RTC
#endif
