// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rt/short_mutex.hpp"
#include <rtm/ConnectorListener.h>
#include <rtm/DirectBuffer.h>
#include <rtm/InPlaceBuffer.h>
#include <rtm/Timestamp.h>

namespace RTC {

class InPortBase;

/// Where the messages of one push connection arrive on the InPort's side, from an OutPort of this process or
/// from an ORB thread. Shared with the sender, so it may outlive the connector: after close() every call
/// reports that the connection is lost, and the port is not touched any more. [any-thread]
class PushReceiver {
  public:
    /// `buffer` takes the messages, or `direct_buffer` the values when the connection is direct (else NULL).
    PushReceiver(InPortBase& port, const ConnectorInfo& info, CdrBufferBase& buffer,
                 std::shared_ptr<DirectBufferBase> direct_buffer = nullptr);
    /// Calls the ON_RECEIVED listeners, stores the message, then calls the listeners of the outcome.
    /// BUFFER_FULL or BUFFER_TIMEOUT when the full-policy refuses it, CONNECTION_LOST after close().
    DataPortStatus receive(ByteData& bytes);
    /// The same, of messages that may have overtaken each other: PORT_OK without doing anything when one with this number or a greater
    /// one has come before.
    DataPortStatus receiveNumbered(std::uint64_t number, ByteData& bytes);
    /// Lets `marshal` write the message straight into the buffer. False when that is not possible (no
    /// InPlaceBuffer, a short message, or somebody needs the bytes); nothing has happened then: use
    /// receive().
    bool receiveInPlace(const Marshal& marshal, DataPortStatus& status) {
        if (!open_mutex_.lock_to(marshal.isWarmUp())) return false;
        const tandem::rt::ShortLock lock(open_mutex_, std::adopt_lock);
        if (!open_ || in_place_ == nullptr || needsBytes()) [[unlikely]]
            return false;
        const BufferStatus written = in_place_->writeInPlace(marshal);
        status = portStatus(written);
        return status == DataPortStatus::PORT_OK || written != BufferStatus::NOT_SUPPORTED;
    }
    /// NULL when the buffer is not an InPlaceBuffer.
    InPlaceBuffer* inPlace() const { return in_place_; }
    /// The same as receive() without serializing the value. False when that is not possible (not a direct connection,
    /// another type, or somebody needs the bytes); nothing has happened then: use receive().
    bool receiveDirect(const DirectValue& message, DataPortStatus& status);
    const std::shared_ptr<DirectBufferBase>& directBuffer() const { return direct_buffer_; }
    /// Returns when no message is being received; later ones are refused.
    void close();

  private:
    DataPortStatus receiveLocked(ByteData& bytes);
    // Of a direct connection with listeners.
    [[gnu::noinline]] DataPortStatus receiveValue(const DirectValue& message);
    // `write` stores the message, `notify` calls the listeners to an event of it.
    template <class Write, class Notify>
    DataPortStatus store(const Write& write, const Notify& notify);
    bool full() const { return direct_buffer_ ? direct_buffer_->full() : buffer_.full(); }
    // A listener reads and may change the serialized message, and the time is stamped into it.
    bool needsBytes() const { return stamps_ || listeners_.hasDataListener(); }
    static DataPortStatus portStatus(BufferStatus written) {
        return written == BufferStatus::OK        ? DataPortStatus::PORT_OK
               : written == BufferStatus::FULL    ? DataPortStatus::BUFFER_FULL
               : written == BufferStatus::TIMEOUT ? DataPortStatus::BUFFER_TIMEOUT
                                                  : DataPortStatus::PORT_ERROR;
    }

    tandem::rt::ShortMutex open_mutex_; // one message at a time; close() waits for it
    bool open_ = true;
    std::uint64_t newest_number_ = 0;
    InPortBase& port_;
    ConnectorListeners& listeners_;
    ConnectorInfo info_;
    CdrBufferBase& buffer_;
    std::shared_ptr<DirectBufferBase> direct_buffer_;
    std::shared_ptr<void> value_;   // of a direct connection with listeners: the copy that they get
    InPlaceBuffer* const in_place_; // buffer_, when it is one
    std::string marshaling_type_;
    const bool stamps_; // the time of a message is set when it comes
};

} // namespace RTC
