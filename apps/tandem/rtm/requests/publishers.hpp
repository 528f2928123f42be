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

/// OutPorts of this program. Each is connected to an InPort of an RTM host while a client publishes there. [one thread]
class Publishers {
  public:
    explicit Publishers(HostComponents& components) : components_(components) {}

    /// Connects to an InPort. `publisher`: its number; `pid`, `link`; `component`: empty for the end of the link;
    /// `port`; `type`: empty if unknown to the link; `signature`; `add_time`. Throws std::runtime_error with one line,
    /// also if the type differs.
    void open(const nlohmann::json& request);
    /// Sends a message (CDR without encapsulation) and waits until the InPort has accepted it. Throws
    /// std::runtime_error with one line if the bytes are not a message of the type, or if it is not accepted.
    void send(const Frame& request);
    void close(const nlohmann::json& request) { publishers_.erase(request.at("publisher").get<int>()); }

  private:
    struct Publisher {
        RemotePort receiver;
        wire::Type message;
        UntypedOutPort port;
        bool add_time; ///< prepend a time to each message, because an OPRoS port has none
        std::unique_ptr<PortConnection> connection; ///< last, so that it ends first
    };

    HostComponents& components_;
    std::map<int, std::unique_ptr<Publisher>> publishers_;
};

} // namespace tandem::command
