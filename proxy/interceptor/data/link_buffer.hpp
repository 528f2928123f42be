// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "host/rt/rehearsal.hpp"
#include "proxy/interceptor/corba/stamped_stream.hpp"
#include "proxy/interceptor/engine/buffer_base.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/link/channel/channel.hpp"
#include "proxy/wire/type.hpp"

#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tandem::interceptor {

/// The channel of a connector's buffer: one of its two ends, according to the port's direction.
struct LinkChannel {
    link::ChannelWriter* writer = nullptr; ///< of an OutPort of the RTC: data go to the peer
    link::ChannelReader* reader = nullptr; ///< of an InPort of the RTC: data come from the peer
    bool timed = false; ///< the messages begin with RTM's time, which travels in the record's header
    /// The message without its time, if it crosses in a form that differs from the RTC's bytes: it contains an any or a
    /// fixed.
    std::shared_ptr<const wire::Type> transcoded{};
};
/// Returns a channel for messages of this type. The caller sets `writer` or `reader`.
LinkChannel make_link_channel(const wire::Type& message);

/// The buffer of a connector between the RTC's port and its mirror. The RTC writes to the ring of the link and reads from
/// it, in the RTC's thread. The buffer factory creates this buffer if a connector profile has `dataport.buffer_type:
/// tandem_link`. [any-thread]
class LinkBuffer final : public engine::BufferBase {
  public:
    static constexpr const char* factory_name = "tandem_link";
    static void register_factory();
    /// Registers a channel under `key`, by which a buffer finds it: the connector's property `dataport.buffer.channel`.
    /// Buffers created before unregister_channel() keep the channel.
    static void register_channel(const std::string& key, const LinkChannel& channel);
    static void unregister_channel(const std::string& key);

    void init(const coil::Properties& properties) override;

    // Nothing here waits, unless `read.empty_policy` is block: the channel knows how many messages may wait, and reading an
    // empty one repeats the last message, or returns EMPTY at once with the policy do_nothing.
    RTC::BufferStatus write(const RTC::ByteData& message, std::chrono::nanoseconds timeout) override;
    RTC::BufferStatus read(RTC::ByteData& message, std::chrono::nanoseconds timeout) override;
    std::size_t readable() const override;
    bool empty() const override { return readable() == 0; }
    RTC::BufferStatus put(const RTC::ByteData& message) override { return write(message, {}); }
    RTC::BufferStatus get(RTC::ByteData& message) override { return read(message, {}); }
    RTC::ByteData& get() override;

    // A ring in shared memory has no slots of ByteData, so it offers neither pointers to slots nor a length.
    std::size_t length() const override { return 0; }
    RTC::BufferStatus length(std::size_t) override { return RTC::BufferStatus::NOT_SUPPORTED; }
    RTC::BufferStatus reset() override;
    RTC::ByteData* wptr(long) override { return nullptr; }
    RTC::BufferStatus advanceWptr(long, bool) override { return RTC::BufferStatus::NOT_SUPPORTED; }
    RTC::ByteData* rptr(long) override { return nullptr; }
    RTC::BufferStatus advanceRptr(long, bool) override { return RTC::BufferStatus::NOT_SUPPORTED; }
    std::size_t writable() const override { return channel_.writer ? 1 : 0; }
    bool full() const override { return false; }

    /// Counts a message that was read, and then not taken by the RTC's port.
    void count_discarded() { channel_.reader->count_discarded(); }

#ifndef TANDEM_RTM_PUBLIC_API
    // Messages are marshalled and unmarshalled in the memory in which they travel, unless they cross in another form.
    std::size_t minInPlaceLength() const override {
        return channel_.transcoded ? std::numeric_limits<std::size_t>::max() : 0;
    }
    RTC::BufferStatus writeInPlace(const RTC::Marshal& marshal) override;
    RTC::BufferStatus readInPlace(RTC::ByteData& message, RTC::Unmarshal& reader,
                                  bool& read_in_place) override;

  private:
    std::optional<RTC::BufferStatus> write_short(const RTC::Marshal& marshal);
    RTC::BufferStatus write_long(const RTC::Marshal& marshal);
    bool read_record(RTC::Unmarshal& reader);
    RTC::BufferStatus read_copy(RTC::ByteData& message);
    RTC::BufferStatus read_nothing_new(RTC::Unmarshal& reader);
    void decode_record(const shm::Record& record, RTC::Unmarshal& reader);
#endif

  private:
    RTC::BufferStatus write_body(std::span<const std::byte> body, std::uint64_t stamp);
    std::span<const std::byte> transcode_to_link(std::span<const std::byte> body);
    template <class Read>
    RTC::BufferStatus read_or_wait(Read&& read_one);
    RTC::BufferStatus copy_message(const shm::Record& record, RTC::ByteData& message);
    /// Returns the status that the RTC gets. Without a peer, it is that of an unconnected port: the message is dropped, but
    /// write() does not fail while the other host restarts.
    RTC::BufferStatus write_status(bool written) const {
        return channel_.writer->is_success(written) ? RTC::BufferStatus::OK : RTC::BufferStatus::FULL;
    }

    LinkChannel channel_;
    link::ChannelReader* in_place_ = nullptr; ///< channel_'s reader, if messages can be read in place
    // Kept, because creating a stream takes longer than using it. With the channel's lock held.
    StampedOutStream out_;
    StampedInStream in_;
    bool readback_ = true;                 ///< an empty ring repeats the last message
    std::chrono::nanoseconds read_wait_{}; ///< how long a reader waits for a message
    bool has_last_ = false;                ///< read() has returned the last message
    /// The last message did not fit into a record of the ring. Used by link_buffer_in_place.cpp, which not every engine has.
    [[maybe_unused]] bool last_was_long_ = false;
    RTC::ByteData last_;                ///< the last result of get()
    std::vector<std::byte> transcoded_; ///< kept for its memory
    shm::MessageSnapshot snapshot_;     ///< of a long message that is read more than once
    process::LogThrottle undecodable_;
};

/// `read_one` returns whether there was a message.
template <class Read>
RTC::BufferStatus LinkBuffer::read_or_wait(Read&& read_one) {
    constexpr auto pause = std::chrono::microseconds(200);
    if (read_one()) return RTC::BufferStatus::OK;
    if (read_wait_.count() == 0) return RTC::BufferStatus::EMPTY;
    const auto deadline = std::chrono::steady_clock::now() + read_wait_;
    while (std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(pause);
        if (read_one()) return RTC::BufferStatus::OK;
    }
    return RTC::BufferStatus::TIMEOUT;
}

} // namespace tandem::interceptor
