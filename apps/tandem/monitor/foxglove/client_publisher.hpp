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

/// The channels that a client advertises, clientPublish of the specification: each is connected with the InPort that receives the
/// messages of its topic, `/LINK/PORT`, and its messages go there beside those of the port's own sender. [one thread]
class ClientPublisher : public std::enable_shared_from_this<ClientPublisher> {
  public:
    static constexpr std::size_t max_channels = 64;

    ClientPublisher(const Channels& channels, RequestProgram& program, ClientLine line)
        : channels_(channels), program_(program), line_(std::move(line)) {}
    /// Tells the program of the requests.
    // NOLINTNEXTLINE(bugprone-exception-escape): only without memory, and then the monitor ends
    ~ClientPublisher();

    /// Objects of the specification. Throws nlohmann::json::exception for what is none.
    void advertise(const nlohmann::json& channels);
    void unadvertise(const nlohmann::json& ids);
    /// A message on one of them: CDR with its encapsulation, or JSON.
    void message(std::uint32_t channel, std::string_view payload);

  private:
    struct Channel {
        int publisher = 0;
        std::string topic;
        wire::Type message;
        bool json = false;
        std::uint64_t dropped = 0; ///< for lack of room
    };

    void advertise_one(const nlohmann::json& channel);
    void open(std::uint32_t id, Channel channel, nlohmann::json request);
    void drop(std::uint32_t id, const std::string& why);

    const Channels& channels_;
    RequestProgram& program_;
    const ClientLine line_;
    std::map<std::uint32_t, Channel> advertised_; ///< by the client's number
};

/// The InPort that receives the messages of a port, for `tandem rtm requests`: `pid`, `link`, `component`, `port`, `type`,
/// `signature`, `add_time`. Throws std::runtime_error, one line, if there is none that can be reached.
nlohmann::json receiver_of(const command::FollowedPort& port, const LinkState& link);

} // namespace tandem::monitor
