// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/adaptor/archive/type_check.hpp"
#include "proxy/link/channel/channel.hpp"

#include <DataPortSource.h>
#include <IDataPortLink.h>
#include <InputDataPortInterface.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace tandem::adaptor {

class MirrorOutPort;

/// A message that was taken off the ring for a target that has not read it yet.
struct KeptMessage {
    std::vector<std::byte> bytes;
    std::uint64_t stamp = 0;
};

/// The source of one OPRoS input port that reads from a MirrorOutPort. A single target reads the ring directly, and the
/// ring skips messages that its queue has no room for. With several targets, the first one that reads takes the messages
/// off the ring and keeps a copy for each of the others. [one thread at a time: the target calls under its own lock]
class OutTap final : public DataPortSource {
  public:
    OutTap(MirrorOutPort& port, InputDataPortInterface& target, TypeCheck check);

    InputDataPortInterface& target() const { return target_; }
    DataPortListener* listener() const { return listener_; }
    std::size_t depth() const { return depth_; } ///< of the target's queue; 0: unlimited
    std::size_t capacity() const;                ///< the most messages that keep() lets wait
    std::size_t kept() const { return kept_count_; }
    const IDataPortLink* connection = nullptr; ///< the host's connection, if there is one

    /// Copies a message for a later take(). Drops the oldest one if more wait than the target's queue holds. With the
    /// port's lock held.
    void keep(std::span<const std::byte> bytes, std::uint64_t stamp);

    // DataPortSource
    bool take(opros_any* value) override;
    bool again(opros_any& value) override;
    long waiting() override;
    void setDepth(std::size_t values) override;
    bool waitsForRoom() override;
    void discarded() override;
    bool setListener(DataPortListener* listener) override;
    void undecodable(const std::string& why) override;

  private:
    friend class MirrorOutPort;
    bool read_beside_others(opros_any* value);
    const shm::Record* read_for_all();
    void skip_beyond_depth();
    void count_dropped();
    void forget_oldest_kept();
    bool take_kept(opros_any* value);
    bool decode(std::span<const std::byte> bytes, std::uint64_t stamp, opros_any* value);
    bool decode_by_archive(std::span<const std::byte> bytes, std::uint64_t stamp, opros_any& value);
    std::optional<std::span<const std::byte>> convert(std::span<const std::byte> bytes);
    void report_undecodable(const std::string& why);

    MirrorOutPort& port_;
    InputDataPortInterface& target_;
    TypeCheck check_;
    const bool plain_;      ///< a message is exactly the value's CDR
    const bool checks_;     ///< a message is checked before it is decoded, and so read twice
    std::size_t depth_ = 0; ///< changed with the channel's lock held
    DataPortListener* listener_ = nullptr;
    std::size_t message_bytes_ = 0; ///< of the last message
    process::LogThrottle undecodable_, dropped_;
    wire::MessageBuffer converted_; ///< a message after its conversion; kept for its memory
    shm::MessageSnapshot snapshot_; ///< of a long message that is read more than once
    std::vector<KeptMessage> kept_; ///< a ring buffer that grows; used from the second target on
    std::size_t first_kept_ = 0, kept_count_ = 0;
};

} // namespace tandem::adaptor
