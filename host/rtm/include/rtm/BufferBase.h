// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_BUFFERBASE_H
#define RTC_BUFFERBASE_H
#include <chrono>
#include <coil/Properties.h>
#include <cstddef>
#include <rtm/BufferStatus.h>

namespace RTC {

/// The queue between a connector and a port. A connector calls write(), a port calls readable() and read(), at the
/// same time in different threads. The interface is OpenRTM-aist's. A connection may name an implementation in a
/// library (CdrBufferFactory).
template <class DataType>
class BufferBase {
  public:
    virtual ~BufferBase() = default;
    /// Is called with the connector's properties below `buffer.`, once for each connection that uses the buffer.
    virtual void init(const coil::Properties& prop) = 0;
    virtual std::size_t length() const = 0;
    virtual BufferStatus length(std::size_t n) = 0;
    virtual BufferStatus reset() = 0;
    virtual DataType* wptr(long int n = 0) = 0;
    virtual BufferStatus advanceWptr(long int n = 1, bool unlock_enable = true) = 0;
    virtual BufferStatus put(const DataType& value) = 0;
    /// Appends a value. Returns FULL or TIMEOUT if the value is not accepted. A negative timeout uses the buffer's
    /// policy.
    virtual BufferStatus write(const DataType& value,
                               std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1)) = 0;
    /// Ours: writes like write(). Sets `overwritten` to whether a value was dropped to make room for this one.
    virtual BufferStatus writeReporting(const DataType& value, bool& overwritten) {
        const bool was_full = full();
        const BufferStatus status = write(value);
        overwritten = was_full && status == BufferStatus::OK;
        return status;
    }
    virtual std::size_t writable() const = 0;
    virtual bool full() const = 0;
    virtual DataType* rptr(long int n = 0) = 0;
    virtual BufferStatus advanceRptr(long int n = 1, bool unlock_enable = true) = 0;
    virtual BufferStatus get(DataType& value) = 0;
    virtual DataType& get() = 0;
    /// Takes the oldest value. Returns EMPTY or TIMEOUT if there is none.
    virtual BufferStatus read(DataType& value,
                              std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1)) = 0;
    virtual std::size_t readable() const = 0;
    virtual bool empty() const = 0;
};

} // namespace RTC
#endif
