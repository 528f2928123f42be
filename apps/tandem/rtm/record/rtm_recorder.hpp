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

/// Writes the messages of OutPorts to an MCAP file. Each port is a channel `/COMPONENT/PORT` with CDR messages, their
/// encapsulation, and the type as IDL. Log time: reception; publish time: the sender's `tm`, if any. `/tandem/drops`
/// counts lost messages. [main-thread]
class RtmRecorder {
  public:
    /// `writer` must outlive the recorder.
    explicit RtmRecorder(mcap::McapWriter& writer) : writer_(writer) {}

    /// Connects to an OutPort and starts to record it. Returns false, without side effects, if it is already recorded.
    /// Throws std::runtime_error if the port is of another kind, its type is unknown, or the connection fails.
    bool add(RemotePort port, const std::vector<std::string>& properties);
    /// Writes received messages, and waits for the first at most for `timeout`. Throws mcap::Error.
    void write_received(std::chrono::milliseconds timeout);
    /// Writes changed counts of dropped messages, and reconnects where needed. Calls the components.
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
    ReceivedSamples samples_; ///< must outlive the ports
    std::vector<Channel> ports_;
    std::map<std::string, std::uint16_t> schemas_; ///< by type
    std::uint16_t drops_channel_ = 0;
    std::uint32_t drops_sequence_ = 0;
    std::uint64_t messages_ = 0;
    std::vector<std::byte> message_; ///< reused, so that messages need no allocation
};

} // namespace tandem::command
