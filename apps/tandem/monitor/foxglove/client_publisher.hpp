// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/control/request_program.hpp"
#include "apps/tandem/monitor/foxglove/channels.hpp"
#include "apps/tandem/monitor/foxglove/client_line.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace tandem::monitor {

/// The channels that a client advertises (clientPublish of the specification). Each is connected to the InPort that
/// receives the messages of its topic `/LINK/PORT`. The port's own sender stays connected. [one thread]
class ClientPublisher : public std::enable_shared_from_this<ClientPublisher> {
  public:
    static constexpr std::size_t max_channels = 64;

    ClientPublisher(const Channels& channels, RequestProgram& program, ClientLine line)
        : channels_(channels), program_(program), line_(std::move(line)) {}
    /// Removes the publishers from the request program.
    // NOLINTNEXTLINE(bugprone-exception-escape): only without memory, and then the monitor ends
    ~ClientPublisher();

    /// Take objects of the specification. Throw nlohmann::json::exception for any other JSON.
    void advertise(const nlohmann::json& channels);
    void unadvertise(const nlohmann::json& ids);
    /// Publishes a message on an advertised channel: CDR with its encapsulation, or JSON.
    void message(std::uint32_t channel, std::string_view payload);

  private:
    struct Channel {
        int publisher = 0;
        std::string topic;
        wire::Type message;
        bool json = false;
        std::uint64_t dropped = 0; ///< because the queue was full
    };

    void advertise_one(const nlohmann::json& channel);
    void open(std::uint32_t id, Channel channel, nlohmann::json request);
    void drop(std::uint32_t id, const std::string& why);

    const Channels& channels_;
    RequestProgram& program_;
    const ClientLine line_;
    std::map<std::uint32_t, Channel> advertised_; ///< by the client's number
};

/// Returns the InPort that receives a port's messages, for `tandem rtm requests`: `pid`, `link`, `component`, `port`,
/// `type`, `signature`, `add_time`. Throws std::runtime_error with one line if no such port is reachable.
nlohmann::json receiver_of(const command::FollowedPort& port, const LinkState& link);

} // namespace tandem::monitor
