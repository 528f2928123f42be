// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/data/mirror_out_port.hpp"
#include "proxy/adaptor/event/mirror_event_out_port.hpp"
#include "proxy/adaptor/service/mirror_required_port.hpp"
#include "proxy/adaptor/share/out_connection.hpp"
#include "proxy/adaptor/share/shared_required_port.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/protocol/control.hpp"

#include <ComponentDirectory.h>
#include <LifecycleListener.h>

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
class SharedComponent final : private LifecycleListener {
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

    /// Connects the ports of the table that belong to this component with the link; `owner` is the name of the component
    /// that shares it. `state_changed` is called after
    /// each change of the component's state; it must not wait. [main-thread]
    void connect(const std::string& owner, const link::PortTable& table, link::Link& link,
                 const SetArrivalListener& set_listener, std::chrono::milliseconds call_timeout,
                 std::function<void()> state_changed);
    /// Ends both: on return the component's ports and state are not in use. [main-thread]
    void disconnect();

    /// The component's state now. [any-thread]
    link::control::StateReport report();
    /// Executes control::activate, deactivate, reset or exit. Returns an empty string or an error of one line.
    std::string execute(std::string_view command); // [worker-thread]
    /// The provided service port of that channel name; nullptr when there is none. [worker-thread]
    MirrorRequiredPort* find_service(std::string_view name) const;
    /// The same of a required one. [worker-thread]
    SharedRequiredPort* find_required(std::string_view name) const;
    /// Stops the component if execute() has started it: nobody else has asked for it. [task-thread]
    void peer_lost();

  private:
    void stateChanged(LifecycleState state) override;
    void connect_port(const link::Port& port, link::Link& link, const SetArrivalListener& set_listener,
                      std::chrono::milliseconds call_timeout);

    const std::string name_;
    ComponentDirectory& directory_;
    Component& component_;
    std::string owner_;
    std::function<void()> state_changed_;
    bool connected_ = false;
    std::vector<std::unique_ptr<OutConnection<DataEnds>>> outputs_;
    std::vector<std::unique_ptr<MirrorOutPort>> inputs_;
    std::vector<std::unique_ptr<OutConnection<EventEnds>>> event_outputs_;
    std::vector<std::unique_ptr<MirrorEventOutPort>> event_inputs_;
    std::vector<std::unique_ptr<SharedRequiredPort>> required_;
    std::vector<std::unique_ptr<MirrorRequiredPort>>
        services_; ///< each calls a provided port of the component
    std::atomic<bool> started_by_peer_{false}, exited_{false};
    std::mutex report_mutex_; ///< of two reports, the one with the larger sequence has the later state
    std::uint64_t sequence_ = 0;
};

} // namespace tandem::adaptor
