// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/writer.hpp"
#include "apps/tandem/observe/link_follower.hpp"
#include "apps/tandem/record/call_writer.hpp"
#include "apps/tandem/record/drops.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tandem::command {

/// Writes the messages of links into an MCAP file: each data port is a channel `/LINK/PORT` of CDR messages, with the
/// encapsulation header that DDS puts in front (OMG DDSI-RTPS 2.5, section 10.2.1.2; little endian, XCDR1) and the port's
/// type as IDL; service calls are as CallWriter says. The log time is when this program saw the message, the publish time the
/// sender's stamp. What did not arrive, or was not recorded, is counted on `/LINK/tandem/drops`. [one thread]
class Recorder {
  public:
    /// `writer` must outlive the recorder. Throws shm::Error for an impossible link name.
    Recorder(mcap::McapWriter& writer, const std::vector<std::string>& links,
             const std::vector<std::string>& ports);

    /// Writes what was sent since the last call. `quiet`: nobody makes a service call at this moment, so that one look finds
    /// those that there were. `closely`: see LinkFollower::poll(). Returns whether there was anything. Throws mcap::Error.
    bool poll(bool quiet = false, bool closely = true);

    /// Of a lock-step run, where time is that of the simulation: the log time of what is recorded from now on.
    void set_time(std::uint64_t time_ns) { simulated_ns_ = time_ns; }
    /// The same, and a message on `/tandem/steps` for the cycle that the component has just had. What it has sent is recorded
    /// behind it.
    void write_step(std::uint64_t time_ns, std::uint64_t tick, const std::string& host,
                    const std::string& component);
    /// Also what was sent before the recording began, as far as it is still there.
    void begin_with_oldest();

    /// Writes which messages of each port were dropped since the recording began, where that has changed.
    void write_drops();

    std::uint64_t messages() const { return messages_; }
    std::uint64_t calls() const { return call_writer_.calls(); }
    /// Calls whose slots were used again before they were copied.
    std::uint64_t lost_calls() const;
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
    std::uint64_t log_time() const;
    void write_drop(Link& link, const std::string& port, const Drops& drops);
    std::uint16_t add_schema(const std::string& name, const std::string& text);

    mcap::McapWriter& writer_;
    const std::vector<std::string> port_names_;
    std::vector<Link> links_;
    CallWriter call_writer_;
    std::optional<std::uint64_t> simulated_ns_; ///< of a lock-step run
    std::uint16_t steps_channel_ = 0;
    std::uint32_t steps_ = 0;
    std::map<std::pair<std::string, std::string>, std::uint16_t> schemas_; ///< by name and text
    std::map<std::string, bool> channels_;                                 ///< topics
    std::vector<std::byte> message_; ///< kept, so that a message costs no allocation
    std::uint64_t messages_ = 0;
};

} // namespace tandem::command
