// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rt/short_mutex.hpp"
#include <atomic>
#include <memory>
#include <optional>
#include <rtm/ConnectorListener.h>
#include <rtm/DirectBuffer.h>
#include <rtm/InPlaceBuffer.h>
#include <rtm/Timestamp.h>
#include <thread>

namespace RTC {

class InPortBase;
class MessageRingReader;
class MessageServer;

/// Where the messages of one push connection arrive on the InPort's side, from an OutPort of this process, an ORB thread
/// or a MessageServer's. Shared with the sender, so it may outlive the connector: after close() every call reports that
/// the connection is lost, and the port is not touched any more. [any-thread]
class PushReceiver : public std::enable_shared_from_this<PushReceiver> {
  public:
    /// `buffer` takes the messages, or `direct_buffer` the values when the connection is direct (else NULL).
    PushReceiver(InPortBase& port, const ConnectorInfo& info, CdrBufferBase& buffer,
                 std::shared_ptr<DirectBufferBase> direct_buffer = nullptr);
    ~PushReceiver();
    /// Calls the ON_RECEIVED listeners, stores the message, then calls the listeners of the outcome.
    /// BUFFER_FULL or BUFFER_TIMEOUT when the full-policy refuses it, CONNECTION_LOST after close().
    DataPortStatus receive(ByteData& bytes);
    /// The same, of messages that may have overtaken each other: PORT_OK without doing anything when one with this number or a greater
    /// one has come before.
    DataPortStatus receiveNumbered(std::uint64_t number, ByteData& bytes);

    // Of a connection whose sender puts messages into a ring of shared memory, if it can, and sends all others by calls.
    /// From now on that ring's messages are received, too. False after close(). `little_endian`: their byte order.
    bool openRing(std::unique_ptr<MessageRingReader> ring, bool little_endian);
    /// receive() of a message that was sent by a call, behind what is in the ring. If there are listeners, the next calls may come
    /// through shared memory.
    DataPortStatus receiveCall(ByteData& bytes);
    /// Receives what is in the ring, calling listeners.
    void takeAll();
    /// The same for who looks at the port, perhaps with a lock held that a listener needs: if there are listeners nothing is received,
    /// and messages come by calls from now on. Does not wait for a thread that is receiving. [port's reading thread]
    void takeArrived();

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
    /// Returns when no message is being received; later ones are refused, but for those that are in the ring already.
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

    /// Lets one thread at a time take messages from the ring.
    class RingTurn;
    std::optional<DataPortStatus> takeFromRing(); // the status of the last message; empty: there was none
    void serveCalls();

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

    std::atomic<std::thread::id> ring_owner_{std::thread::id()}; // the thread that has the turn
    std::unique_ptr<MessageRingReader> ring_;                    // this and what follows: who has the turn
    ByteData ring_message_;
    bool has_tried_to_serve_ = false;
    std::unique_ptr<MessageServer> server_;
};

} // namespace RTC
