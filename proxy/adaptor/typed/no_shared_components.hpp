// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/engine/arrival_listener.hpp"
#include "proxy/adaptor/typed/typed_required_port.hpp"
#include "proxy/link/link.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

class ComponentDirectory;

namespace tandem::adaptor {

/// Components of a real engine do not know each other: `share` is refused, and nothing is shared.
class NoSharedComponents {
  public:
    NoSharedComponents(const std::string&, std::chrono::milliseconds) {}

    /// Adds a line to `useless` if names are given.
    static link::PortTable find(const std::vector<std::string>& names,
                                const std::map<std::string, std::string>&, ComponentDirectory*,
                                std::vector<std::string>& useless);
    void connect(link::Link& link, const std::function<void(const link::Port&, engine::ArrivalListener*)>&,
                 const std::function<void()>&) {
        link_ = &link;
    }
    static std::optional<link::PortTable> follow_ports() { return std::nullopt; }
    void disconnect() {}
    /// Executes the only command that concerns no shared component: the list of ports that the peer listens to.
    link::Reply serve(const link::Request& request) const;
    static TypedRequiredPort* find_service(std::string_view) { return nullptr; }
    void peer_connected() {}
    void peer_lost() {}

  private:
    link::Link* link_ = nullptr;
};

} // namespace tandem::adaptor
