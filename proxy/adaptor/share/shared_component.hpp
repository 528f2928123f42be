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
#include <vector>

namespace tandem::adaptor {

/// Tells somebody, or with nullptr nobody, of messages that arrive in a channel of the link.
using SetArrivalListener = std::function<void(const std::string& channel, DataPortListener* listener)>;

/// One OPRoS component that the RTM side shows as an RTC. Its channels in the link are named COMPONENT.PORT.
class SharedComponent final : private LifecycleListener, private PortListener {
  public:
    /// `directory` has a component of that name and outlives this object.
    SharedComponent(std::string name, ComponentDirectory& directory);
    ~SharedComponent() override;
    SharedComponent(const SharedComponent&) = delete;
    SharedComponent& operator=(const SharedComponent&) = delete;

    const std::string& name() const { return name_; }
    /// Appends the component and those of its ports that can cross: see describe_ports().
    std::vector<std::string> describe(link::PortTable& table,
                                      const std::map<std::string, std::string>& interfaces) const;

    /// Called after each change of the component's state, and after it has added a port; must not wait. [any-thread]
    struct Changes {
        std::function<void()> state, ports;
    };
    /// Watches the component. [main-thread]
    void watch(Changes changes);
    /// Connects a port of this component with the link; `owner` is the name of the component that shares it. [one thread at
    /// a time]
    void connect_port(const std::string& owner, const link::Port& port, link::Link& link,
                      const SetArrivalListener& set_listener, std::chrono::milliseconds call_timeout);
    /// Ends both: on return the component's ports and state are not in use. [main-thread]
    void disconnect();

    /// The component's state now. [any-thread]
    link::control::StateReport report();
    /// Executes control::activate, deactivate, reset or exit. Returns an empty string or an error of one line.
    std::string execute(std::string_view command); // [worker-thread]
    /// The provided service port of that channel name; nullptr when there is none. [worker-thread]
    MirrorRequiredPort* find_service(std::string_view name) const { return services_by_name_.find(name); }
    /// The same of a required one. [worker-thread]
    SharedRequiredPort* find_required(std::string_view name) const { return required_by_name_.find(name); }
    /// Stops the component if execute() has started it: nobody else has asked for it. [task-thread]
    void peer_lost();

  private:
    void stateChanged(LifecycleState) override { changes_.state(); }
    void portAdded(const std::string&, Port&) override { changes_.ports(); }
    void portRemoved(const std::string&, Port&) override {} // an OPRoS component removes none by itself

    const std::string name_;
    ComponentDirectory& directory_;
    Component& component_;
    Changes changes_;
    bool watched_ = false;
    std::vector<std::unique_ptr<OutConnection<DataEnds>>> outputs_;
    std::vector<std::unique_ptr<MirrorOutPort>> inputs_;
    std::vector<std::unique_ptr<OutConnection<EventEnds>>> event_outputs_;
    std::vector<std::unique_ptr<MirrorEventOutPort>> event_inputs_;
    std::vector<std::unique_ptr<SharedRequiredPort>> required_;
    std::vector<std::unique_ptr<MirrorRequiredPort>>
        services_; ///< each calls a provided port of the component
    link::Registry<SharedRequiredPort> required_by_name_;
    link::Registry<MirrorRequiredPort> services_by_name_;
    std::atomic<bool> started_by_peer_{false}, exited_{false};
    std::mutex report_mutex_; ///< of two reports, the one with the larger sequence has the later state
    std::uint64_t sequence_ = 0;
};

} // namespace tandem::adaptor
