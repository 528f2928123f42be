// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/writer.hpp"
#include "apps/tandem/record/drops.hpp"
#include "apps/tandem/rtm/record/recorded_port.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tandem::command {

/// Writes what OutPorts send into an MCAP file: each is a channel `/COMPONENT/PORT` of CDR messages with their encapsulation and the
/// type as IDL. The log time is when the message came, the publish time the sender's `tm`, if it has one. What was lost is counted on
/// `/tandem/drops`. [main-thread]
class RtmRecorder {
  public:
    /// `writer` must outlive the recorder.
    explicit RtmRecorder(mcap::McapWriter& writer) : writer_(writer) {}

    /// Connects with an OutPort and records it from now on; nothing, and false, if it is recorded already. Throws std::runtime_error for a
    /// port of another kind, of a type that is not known here, or that cannot be connected.
    bool add(RemotePort port, const std::vector<std::string>& properties);
    /// Writes what has come, and waits for it at most so long. Throws mcap::Error.
    void write_received(std::chrono::milliseconds timeout);
    /// Writes which messages were dropped, where that has changed, and connects again where it has to. Calls the components.
    void look_after();

    std::uint64_t messages() const { return messages_; }
    std::uint64_t not_recorded() const;
    std::uint64_t lost_by_senders() const;
    std::size_t ports() const { return ports_.size(); }

  private:
    struct Channel {
        std::unique_ptr<RecordedPort> port;
        std::uint16_t id = 0;
        bool timed = false;
        std::uint32_t sequence = 0;
        std::uint64_t undecodable = 0, seen = 0;
        Drops drops{}; ///< as last written
    };
    void write(const ReceivedSample& sample);
    void write_drops(Channel& channel, const Drops& drops);

    mcap::McapWriter& writer_;
    ReceivedSamples samples_; ///< outlives the ports
    std::vector<Channel> ports_;
    std::map<std::string, std::uint16_t> schemas_; ///< by type
    std::uint16_t drops_channel_ = 0;
    std::uint32_t drops_sequence_ = 0;
    std::uint64_t messages_ = 0;
    std::vector<std::byte> message_; ///< kept, so that a message costs no allocation
};

} // namespace tandem::command
