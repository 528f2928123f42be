// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/rtm/requests/frame.hpp"
#include "apps/tandem/rtm/requests/host_components.hpp"
#include "apps/tandem/rtm/stream/untyped_ports.hpp"
#include "proxy/wire/type.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace tandem::command {

/// OutPorts of this program, each connected with one InPort of an RTM host for as long as a client publishes there.
/// [one thread]
class Publishers {
  public:
    explicit Publishers(HostComponents& components) : components_(components) {}

    /// Connects with an InPort. `publisher`: its number; `pid`, `link`; `component`, empty for the end of the link; `port`;
    /// `type`, empty if the link does not know it; `signature`; `add_time`. Throws std::runtime_error, one line, also for a port of another type.
    void open(const nlohmann::json& request);
    /// Sends one message, CDR without encapsulation, and waits until the InPort has taken it. Throws std::runtime_error, one
    /// line, if it is no message of the type, or is not taken.
    void send(const Frame& request);
    void close(const nlohmann::json& request) { publishers_.erase(request.at("publisher").get<int>()); }

  private:
    struct Publisher {
        RemotePort receiver;
        wire::Type message;
        UntypedOutPort port;
        bool add_time;                              ///< in front of each message: an OPRoS port has none
        std::unique_ptr<PortConnection> connection; ///< last: it ends first
    };

    HostComponents& components_;
    std::map<int, std::unique_ptr<Publisher>> publishers_;
};

} // namespace tandem::command
