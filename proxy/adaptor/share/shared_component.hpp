// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/data/mirror_out_port.hpp"
#include "proxy/adaptor/event/mirror_event_out_port.hpp"
#include "proxy/adaptor/service/mirror_required_port.hpp"
#include "proxy/adaptor/share/out_connection.hpp"
#include "proxy/adaptor/share/shared_required_port.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/registry.hpp"

#include <ComponentDirectory.h>
#include <LifecycleListener.h>
#include <PortListener.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tandem::adaptor {

/// Sets the listener for messages that arrive in a channel of the link; nullptr: none.
using SetArrivalListener = std::function<void(const link::Port& port, DataPortListener* listener)>;

/// One OPRoS component that the RTM side shows as an RTC. Its channels in the link are named COMPONENT.PORT.
class SharedComponent final : private LifecycleListener, private PortListener {
  public:
    /// `directory` contains a component of this name and outlives this object.
    SharedComponent(std::string name, ComponentDirectory& directory);
    ~SharedComponent() override;
    SharedComponent(const SharedComponent&) = delete;
    SharedComponent& operator=(const SharedComponent&) = delete;

    const std::string& name() const { return name_; }
    /// Appends the component and its ports that can cross: see describe_ports().
    std::vector<std::string> describe(link::PortTable& table,
                                      const std::map<std::string, std::string>& interfaces) const;

    /// Returns the names of the properties that the peer may set. [any-thread]
    std::vector<std::string> property_names() const;
    /// Called when the peer has set a property. [worker-thread]
    void property_set(const std::string& name, const std::string& value);

    /// Called after each change of the component's state and of its ports. Must not wait. [any-thread]
    struct Changes {
        std::function<void()> state, ports;
    };
    /// Starts to watch the component. [main-thread]
    void watch(Changes changes);
    /// Connects a port of this component with the link, unless it is connected. `owner` is the name of the component that
    /// shares it. The port is disconnected when the component removes it. [one thread at a time]
    void connect_port(const std::string& owner, const link::Port& port, link::Link& link,
                      const SetArrivalListener& set_listener, std::chrono::milliseconds call_timeout);
    /// Ends watching and all connections: on return the component's ports and state are not in use. [main-thread]
    void disconnect();

    /// Returns the component's current state. [any-thread]
    link::control::StateReport report();
    /// Executes control::activate, deactivate, reset or exit. Returns an empty string or an error of one line.
    std::string execute(std::string_view command); // [worker-thread]
    /// Returns the provided service port with this channel name; nullptr if there is none. [worker-thread]
    MirrorRequiredPort* find_service(std::string_view name) const { return services_by_name_.find(name); }
    /// Returns the required service port with this channel name; nullptr if there is none. [worker-thread]
    SharedRequiredPort* find_required(std::string_view name) const { return required_by_name_.find(name); }
    /// Stops the component if execute() has started it, because nobody else has asked for it. [task-thread]
    void peer_lost();

  private:
    void stateChanged(LifecycleState) override { changes_.state(); }
    void portAdded(const std::string&, Port&) override { changes_.ports(); }
    void portRemoved(const std::string& name, Port& port) override;

    /// The object that connects a port with the link.
    using Connection =
        std::variant<std::monostate, std::unique_ptr<OutConnection<DataEnds>>, std::unique_ptr<MirrorOutPort>,
                     std::unique_ptr<OutConnection<EventEnds>>, std::unique_ptr<MirrorEventOutPort>,
                     std::unique_ptr<MirrorRequiredPort>, std::unique_ptr<SharedRequiredPort>>;
    struct ConnectedPort {
        link::Port port; ///< as it was at connection
        const Port* own = nullptr;
        Connection connection{}; ///< none: the port does not fit
    };
    Connection make_connection(const std::string& owner, const link::Port& port, Port* own, link::Link& link,
                               const SetArrivalListener& set_listener, std::chrono::milliseconds call_timeout,
                               std::string& error);
    void end(Connection connection);

    const std::string name_;
    ComponentDirectory& directory_;
    Component& component_;
    Changes changes_;
    bool watched_ = false;
    /// The properties that the component had before it ran, with the peer's changes. Its own ones are not thread-safe.
    std::map<std::string, std::string> properties_;
    mutable std::mutex properties_mutex_;        ///< the one above
    std::mutex ports_mutex_;                     ///< the two below
    std::map<std::string, ConnectedPort> ports_; ///< by the component's names
    std::vector<Connection> ended_;              ///< of service ports, in which a call may still run
    link::Registry<SharedRequiredPort> required_by_name_;
    link::Registry<MirrorRequiredPort> services_by_name_;
    std::atomic<bool> started_by_peer_{false}, exited_{false};
    std::mutex report_mutex_; ///< of two reports, the one with the larger sequence has the later state
    std::uint64_t sequence_ = 0;
};

} // namespace tandem::adaptor
