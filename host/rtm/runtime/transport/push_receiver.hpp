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

/// Receives the messages of one push connection on the InPort's side, from an OutPort of this process, an ORB thread or
/// a MessageServer's thread. Shared with the sender, so it may outlive the connector. After close() every call reports
/// that the connection is lost and does not use the port. [any-thread]
class PushReceiver : public std::enable_shared_from_this<PushReceiver> {
  public:
    /// `buffer` takes the messages. In a direct connection `direct_buffer` takes the values; otherwise it is NULL.
    PushReceiver(InPortBase& port, const ConnectorInfo& info, CdrBufferBase& buffer,
                 std::shared_ptr<DirectBufferBase> direct_buffer = nullptr);
    ~PushReceiver();
    /// Calls the ON_RECEIVED listeners, stores the message, then calls the listeners of the outcome. Returns
    /// BUFFER_FULL or BUFFER_TIMEOUT if the full-policy refuses the message, CONNECTION_LOST after close().
    DataPortStatus receive(ByteData& bytes);
    /// Receives a message that may have overtaken others. Returns PORT_OK, without side effects, if a message with this
    /// number or a greater one has already arrived. Otherwise does the same as receive().
    DataPortStatus receive_numbered(std::uint64_t number, ByteData& bytes);

    // For connections whose sender puts messages into a ring of shared memory if possible, and sends all others by
    // calls.
    /// Also receives the messages of this ring from now on. Returns false after close(). `little_endian`: their byte
    /// order.
    bool open_ring(std::unique_ptr<MessageRingReader> ring, bool little_endian);
    /// Receives a message that was sent by a call, after the messages in the ring. If there are listeners, later calls
    /// may come through shared memory.
    DataPortStatus receive_by_call(ByteData& bytes);
    /// Receives the messages in the ring and calls the listeners.
    void receive_from_ring();
    /// Receives the messages in the ring for a caller that looks at the port, perhaps with a lock held that a listener
    /// needs. If there are listeners, receives nothing, and messages come by calls from now on. Does not wait for a
    /// thread that is receiving. [port's reading thread]
    void try_receive_from_ring();

    /// Lets `marshal` write the message directly into the buffer. Returns false, without side effects, if that is not
    /// possible: there is no InPlaceBuffer, the message is short, or the bytes are needed. Use receive() then.
    bool receive_in_place(const Marshal& marshal, DataPortStatus& status) {
        if (!open_mutex_.lock_unless_rehearsing()) return false;
        const tandem::rt::ShortLock lock(open_mutex_, std::adopt_lock);
        if (!open_ || in_place_ == nullptr || needs_bytes()) [[unlikely]]
            return false;
        const BufferStatus written = in_place_->writeInPlace(marshal);
        status = port_status(written);
        return status == DataPortStatus::PORT_OK || written != BufferStatus::NOT_SUPPORTED;
    }
    /// Returns NULL if the buffer is not an InPlaceBuffer.
    InPlaceBuffer* in_place_buffer() const { return in_place_; }
    /// Receives the value without serializing it. Returns false, without side effects, if that is not possible: the
    /// connection is not direct, the type differs, or the bytes are needed. Use receive() then.
    bool receive_direct(const DirectValue& message, DataPortStatus& status);
    const std::shared_ptr<DirectBufferBase>& direct_buffer() const { return direct_buffer_; }
    /// Returns when no message is being received. Later messages are refused, except those that are already in the
    /// ring.
    void close();

  private:
    DataPortStatus receive_locked(ByteData& bytes);
    // For a direct connection with listeners.
    DataPortStatus receive_value(const DirectValue& message);
    // `write` stores the message and sets `overwritten`, `notify` calls the listeners to an event of it.
    template <class Write, class Notify>
    DataPortStatus store(const Write& write, const bool& overwritten, const Notify& notify);
    // A listener reads and may change the serialized message, and the time is stamped into it.
    bool needs_bytes() const { return stamps_ || listeners_.hasDataListener(); }
    static DataPortStatus port_status(BufferStatus written) {
        return written == BufferStatus::OK        ? DataPortStatus::PORT_OK
               : written == BufferStatus::FULL    ? DataPortStatus::BUFFER_FULL
               : written == BufferStatus::TIMEOUT ? DataPortStatus::BUFFER_TIMEOUT
                                                  : DataPortStatus::PORT_ERROR;
    }

    /// Lets one thread at a time receive the messages in the ring.
    class RingTurn;
    // For the thread that has the turn. Returns the status of the last message; empty if there was none.
    std::optional<DataPortStatus> receive_with_turn();
    void start_server();

    tandem::rt::ShortMutex open_mutex_; // one message at a time; close() waits for it
    bool open_ = true;
    std::uint64_t newest_number_ = 0;
    InPortBase& port_;
    ConnectorListeners& listeners_;
    ConnectorInfo info_;
    CdrBufferBase& buffer_;
    std::shared_ptr<DirectBufferBase> direct_buffer_;
    std::shared_ptr<void> value_;   // of a direct connection with listeners: the copy that they get
    InPlaceBuffer* const in_place_; // buffer_, when it is one and takes the messages
    std::string marshaling_type_;
    const bool stamps_; // the time of a message is set when it comes

    std::atomic<std::thread::id> ring_owner_{std::thread::id()}; // the thread that has the turn
    std::unique_ptr<MessageRingReader> ring_;                    // this and what follows: who has the turn
    ByteData ring_message_;
    bool has_tried_to_serve_ = false;
    std::unique_ptr<MessageServer> server_;
};

} // namespace RTC
