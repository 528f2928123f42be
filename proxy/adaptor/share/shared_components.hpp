// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/share/shared_component.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/link/protocol/request.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// The OPRoS components that the property `share` names, and the peer's commands for them.
class SharedComponents {
  public:
    /// `owner` is AdaptorComp's name, for messages.
    SharedComponents(std::string owner, std::chrono::milliseconds call_timeout)
        : owner_(std::move(owner)), call_timeout_(call_timeout) {}
    ~SharedComponents() { disconnect(); }

    /// Finds the components and describes them. Adds one line to `useless` for each missing component, logs one line for each
    /// port that cannot cross, and leaves them out. With nullptr as `directory`, all components are missing. [main-thread]
    link::PortTable find(const std::vector<std::string>& names,
                         const std::map<std::string, std::string>& interfaces, ComponentDirectory* directory,
                         std::vector<std::string>& useless);

    /// Connects their ports with the link, whose own table is that of find(). `ports_changed` is called when a component
    /// has added or removed a port; it must not wait. [main-thread]
    void connect(link::Link& link, const SetArrivalListener& set_listener,
                 const std::function<void()>& ports_changed);
    /// Connects ports that the components have added since. Returns the new table with added and without removed ports;
    /// nothing if it is unchanged. [task-thread]
    std::optional<link::PortTable> follow_ports();
    /// Disconnects everything: on return the components are no longer in use. Call it before the components and the link
    /// are destroyed. [main-thread]
    void disconnect();

    /// Executes a command for one of the components. [worker-thread]
    link::Reply serve(const link::Request& request);
    /// Returns the provided service port with this channel name; nullptr if there is none. [worker-thread]
    MirrorRequiredPort* find_service(std::string_view name) const;

    // [task-thread]
    void peer_connected();
    void peer_lost();

  private:
    SharedComponent* find(std::string_view name) const;
    link::Reply bind(const link::Request& request);
    link::Reply configure(const link::Request& request);
    void report(SharedComponent& component);
    void describe(const SharedComponent& component, link::PortTable& table);
    void log_removed(const link::Port& port, const link::Port* now);

    const std::string owner_;
    const std::chrono::milliseconds call_timeout_;
    ComponentDirectory* directory_ = nullptr;
    link::Link* link_ = nullptr;
    std::map<std::string, std::string> interfaces_;
    SetArrivalListener set_listener_;
    link::PortTable table_;
    std::set<std::string> told_; ///< logged lines about ports that are not shared
    std::vector<std::unique_ptr<SharedComponent>> components_;
};

} // namespace tandem::adaptor
