// SPDX-License-Identifier: Apache-2.0
// A segment of shared memory for the messages of one connection, with a ring and a call queue, seen from its two ends.
#pragma once
#include "shm/call/call_client.hpp"
#include "shm/os/recent_clock.hpp"
#include "shm/segment.hpp"
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace RTC {

/// The state that the two ends exchange in addition to the messages. In shared memory.
struct RingState {
    /// Set by the reading end: it receives messages whenever the port is looked at. 0: messages must be sent by calls.
    std::atomic<std::uint32_t> accepts_messages;
    /// Set by the reading end: a MessageServer receives messages when it is called.
    std::atomic<std::uint32_t> serves_calls;
};

/// The writing end. [one thread at a time]
class MessageRingWriter {
  public:
    static constexpr std::size_t max_message_bytes = std::size_t{8} << 20;
    /// If the reader has not looked for this time, messages are sent by calls again, which show whether its process
    /// answers.
    static constexpr std::chrono::milliseconds max_unread{100};

    /// Creates the segment of a new link. Throws tandem::shm::Error, for example if /dev/shm is full.
    MessageRingWriter();
    ~MessageRingWriter();

    /// Returns the name for MessageRingReader, in the other process.
    const std::string& link() const { return link_; }
    /// Removes the segment's name once the reader has joined. Other processes then cannot find the segment, and nothing
    /// remains after the end of both processes.
    void remove_name();
    /// Writes a message, which the reader finds when it looks at its port. Returns false, without side effects, if the
    /// message is too long, there is no room, or the reader accepts no messages.
    bool write(std::span<const std::byte> message);
    /// Returns whether the reader wants no more messages. If true after write(), the reader may miss that message until
    /// it is told.
    bool is_refused() const;
    /// Writes a message like write(), for a MessageServer. The server receives the message when call_server() is
    /// called, for this message or a later one.
    bool write_for_server(std::span<const std::byte> message);
    /// Makes the MessageServer receive the messages in the ring, and waits up to `timeout` for its answer. With
    /// CallStatus::ok, the answer is one byte, the PortStatus of the last message, valid until the next call. Statuses
    /// as of CallClient::call_into().
    tandem::shm::ReplyView call_server(std::chrono::milliseconds timeout);

  private:
    bool write_if_read(std::span<const std::byte> message);
    bool is_read();

    const std::string link_;
    std::unique_ptr<tandem::shm::Segment> segment_;
    RingState* state_;
    std::optional<tandem::shm::RingWriter> writer_;
    std::optional<tandem::shm::CallClient> calls_;
    std::vector<std::byte> answer_;
    tandem::shm::RecentClock clock_;
    std::uint64_t checked_at_ns_ = 0, read_at_ns_ = 0, received_ = 0; // see is_read()
    bool is_read_ = true;
};

/// The reading end. [one thread at a time]
class MessageRingReader {
  public:
    /// Throws tandem::shm::Error, for example if there is no such link on this machine.
    explicit MessageRingReader(const std::string& link);
    ~MessageRingReader();

    /// The maximum number of messages in the ring.
    static constexpr std::size_t max_messages = 1024;

    /// Sets whether messages are received when the port is looked at. Until the first call they are not. After
    /// accept_messages(false), read() finds each message whose writer does not find is_refused().
    void accept_messages(bool accept);
    /// Returns the oldest message, valid until the next call; empty if there is none.
    std::optional<std::span<const std::byte>> read();
    /// Returns whether the other process has damaged the ring. If so, no more messages arrive.
    bool is_corrupt() const;
    /// Returns the segment, for a MessageServer.
    const std::shared_ptr<tandem::shm::Segment>& segment() const { return segment_; }
    /// Returns the queue of the writer's calls (MessageRingWriter::call_server()), for a MessageServer.
    const tandem::shm::CallQueueHandle& call_queue() const { return *calls_; }
    /// Permits the writer, from now on, to call the MessageServer.
    void permit_calls() { state_->serves_calls.store(1, std::memory_order_release); }

  private:
    std::shared_ptr<tandem::shm::Segment> segment_;
    std::optional<tandem::shm::CallQueueHandle> calls_;
    RingState* state_ = nullptr;
    bool accepts_ = false;
    std::optional<tandem::shm::RingReader> reader_;
};

} // namespace RTC
