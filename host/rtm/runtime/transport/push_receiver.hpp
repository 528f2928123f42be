// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/ConnectorListener.h>
#include <rtm/DirectBuffer.h>
#include <rtm/InPlaceBuffer.h>
#include <rtm/Timestamp.h>
#include <shared_mutex>

namespace RTC {
class InPortBase;

/// Where messages for one connector arrive, from a writer of this process or from the ORB. It outlives the
/// connector: who still holds it when the connection is gone gets CONNECTION_LOST. [any-thread]
class PushReceiver {
  public:
    /// `direct_buffer`: where values go instead of the buffer, when the connection is direct; else NULL.
    PushReceiver(InPortBase& port, const ConnectorInfo& info, CdrBufferBase& buffer,
                 std::shared_ptr<DirectBufferBase> direct_buffer = nullptr);

    /// ON_RECEIVED listeners, then the buffer, then ON_BUFFER_WRITE (or what came of it).
    DataPortStatus receive(ByteData& bytes);
    /// The same for a message that is made in the buffer. False: it cannot be, and nothing has happened.
    bool receiveInPlace(const Marshal& marshal, DataPortStatus& status);
    InPlaceBuffer* inPlace() const { return in_place_; }
    /// The same for a value of this process that goes as it is.
    bool receiveDirect(const DirectWriter& writer, DataPortStatus& status);
    const std::shared_ptr<DirectBufferBase>& directBuffer() const { return direct_buffer_; }
    /// Returns when no message is on its way through.
    void close();

  private:
    DataPortStatus store(ByteData& bytes);
    bool full() const { return direct_buffer_ ? direct_buffer_->full() : buffer_.full(); }

    std::shared_mutex open_mutex_; // shared by receivers, exclusive to close
    bool open_ = true;
    InPortBase& port_;
    ConnectorListeners& listeners_;
    ConnectorInfo info_;
    CdrBufferBase& buffer_;
    std::shared_ptr<DirectBufferBase> direct_buffer_;
    InPlaceBuffer* const in_place_; // the buffer, if it is one
    std::string marshaling_type_;
    TimestampPolicy timestamp_;
};

} // namespace RTC
