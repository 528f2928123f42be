// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/channel.hpp"

#include <rtm/CdrBufferBase.h>
#include <rtm/InPlaceBuffer.h>

#include <string>

namespace tandem::interceptor {

/// A channel's ends as a connector's buffer sees them, and whether the messages begin with RTM's time.
struct LinkChannel {
    link::ChannelWriter* writer = nullptr; ///< for a buffer that is written: data leave for the peer
    link::ChannelReader* reader = nullptr; ///< for a buffer that is read: data come from the peer
    bool timed = false;
};

/// The buffer of a connector that ends in shared memory: an RTC's port writes to, or polls, the ring itself.
/// RTM's time travels in the record's header. Made by the buffer factory under the name `tandem_link`.
class LinkBuffer final : public RTC::CdrBufferBase, public RTC::InPlaceBuffer {
  public:
    static constexpr const char* factory_name = "tandem_link";
    static void register_factory();
    /// Makes a channel known under `key`, the connector's property `dataport.buffer.channel`.
    static void publish(const std::string& key, const LinkChannel& channel);
    static void withdraw(const std::string& key);

    void init(const coil::Properties& properties) override;

    RTC::BufferStatus write(const RTC::ByteData& message, std::chrono::nanoseconds timeout) override;
    RTC::BufferStatus read(RTC::ByteData& message, std::chrono::nanoseconds timeout) override;
    /// What is too long to be worth a copy is made in the chunk that it crosses in, and read there.
    std::size_t minInPlaceLength() const override { return link::large_message_bytes; }
    RTC::BufferStatus writeInPlace(const RTC::Marshal& marshal) override;
    RTC::BufferStatus readInPlace(RTC::ByteData& message, RTC::Unmarshal& reader,
                                  bool& read_in_place) override;
    std::size_t readable() const override;
    bool empty() const override { return readable() == 0; }
    RTC::BufferStatus put(const RTC::ByteData& message) override { return write(message, {}); }
    RTC::BufferStatus get(RTC::ByteData& message) override { return read(message, {}); }
    RTC::ByteData& get() override;

    // A ring in shared memory has no places that a pointer could stand on.
    std::size_t length() const override { return 0; }
    RTC::BufferStatus length(std::size_t) override { return RTC::BufferStatus::NOT_SUPPORTED; }
    RTC::BufferStatus reset() override;
    RTC::ByteData* wptr(long) override { return nullptr; }
    RTC::BufferStatus advanceWptr(long, bool) override { return RTC::BufferStatus::NOT_SUPPORTED; }
    RTC::ByteData* rptr(long) override { return nullptr; }
    RTC::BufferStatus advanceRptr(long, bool) override { return RTC::BufferStatus::NOT_SUPPORTED; }
    std::size_t writable() const override { return channel_.writer ? 1 : 0; }
    bool full() const override { return false; }

  private:
    void copy(const shm::Record& record, RTC::ByteData& message) const;
    RTC::BufferStatus sent(bool sent) const;

    LinkChannel channel_;
    RTC::ByteData last_;
};

} // namespace tandem::interceptor
