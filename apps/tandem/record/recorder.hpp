// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/writer.hpp"
#include "apps/tandem/observe/link_follower.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tandem::command {

/// Writes the messages of links into an MCAP file: each data port is a channel `/LINK/PORT` of CDR messages, with the
/// encapsulation header that DDS puts in front (OMG DDSI-RTPS 2.5, section 10.2.1.2; little endian, XCDR1) and the port's
/// type as IDL. The log time is when this program saw the message, the publish time the sender's stamp. Messages that did
/// not arrive are counted on `/LINK/tandem/drops`. [one thread]
class Recorder {
  public:
    /// `writer` must outlive the recorder. Throws shm::Error for an impossible link name.
    Recorder(mcap::McapWriter& writer, const std::vector<std::string>& links,
             const std::vector<std::string>& ports);

    /// Writes what was sent since the last call. Returns whether there was anything. Throws mcap::Error.
    bool poll();
    /// Writes which messages of each port were dropped since the recording began, where that has changed.
    void write_drops();

    std::uint64_t messages() const { return messages_; }
    /// Messages that were overwritten before they were copied.
    std::uint64_t lost() const;
    std::size_t ports() const { return channels_.size(); }
    /// Names of the links that have not been there yet.
    std::string absent_links() const;

  private:
    /// A channel of the file and what is known of its port.
    struct Channel {
        std::uint16_t id = 0;
        std::string signature;
    };
    /// What happened to messages of a port that the receiver did not get, or this recorder.
    struct Drops {
        std::uint64_t refused = 0, overwritten = 0, skipped = 0, not_recorded = 0;
        bool operator==(const Drops&) const = default;
    };
    struct Link {
        explicit Link(LinkFollower of) : follower(std::move(of)) {}
        LinkFollower follower;
        std::uint64_t generation = 0;
        std::map<std::string, Channel> channels; ///< by port
        std::map<std::string, Drops> drops;      ///< as last written
        std::uint16_t drops_channel = 0;
        std::uint32_t drops_sequence = 0;
    };

    void add_channels(Link& link);
    void add_channel(Link& link, const LinkFollower::Port& port);
    void write(Link& link, const LinkFollower::Port& port, const shm::FollowedRecord& record);
    void write_drop(Link& link, const std::string& port, const Drops& drops);
    std::uint16_t add_schema(const std::string& name, const std::string& text);

    mcap::McapWriter& writer_;
    std::vector<Link> links_;
    std::map<std::pair<std::string, std::string>, std::uint16_t> schemas_; ///< by name and text
    std::map<std::string, bool> channels_;                                 ///< topics
    std::vector<std::byte> message_; ///< kept, so that a message costs no allocation
    std::uint64_t messages_ = 0;
};

} // namespace tandem::command
