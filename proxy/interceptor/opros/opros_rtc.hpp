// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/data/forwarding_out_port.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/interceptor/opros/opros_in_port.hpp"
#include "proxy/interceptor/service/mirror_provided_port.hpp"
#include "proxy/interceptor/service/mirror_required_port.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/protocol/port_types.hpp"
#include "proxy/link/registry.hpp"

#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// Shows one OPRoS component as an RTC: its data, event and service ports, its properties as configuration parameters, and
/// its life cycle. Activating, deactivating or resetting this RTC starts, stops or recovers the OPRoS component. The RTC
/// follows state changes of the OPRoS component. The thread of its execution context runs when data have come.
class OprosRtc final : public RTC::DataFlowComponentBase {
  public:
    static constexpr const char* implementation_id = "OprosComponent";

    /// What an OprosRtc is created from.
    struct Source {
        link::SharedComponent component;
        std::vector<link::Port> ports; ///< of the component
        link::Link* link = nullptr;
        std::string link_name;
        std::chrono::milliseconds call_timeout{};
        std::function<void()>
            connections_changed; ///< called when an OutPort was connected or disconnected; must not wait
        std::function<void()> configuration_changed; ///< must not wait
        std::function<void()> finalized;             ///< called when it has left the manager; must not wait
    };

    /// Creates the RTC in the manager, under the component's name. Throws std::runtime_error, one line. The link must
    /// outlive all references to it.
    static OprosRtc& create(RTC::Manager& manager, Source source);

    explicit OprosRtc(RTC::Manager* manager);
    ~OprosRtc() override;

    const Source& source() const { return source_; }
    bool is_finalized() const { return finalized_; }
    /// Ends the RTC without telling the OPRoS component, which continues.
    void leave(RTC::Manager& manager);

    /// Stores the component's state: from here on no cycle of an RTC that should be in ERROR succeeds. Returns false for a
    /// report that is older than another one. [any-thread]
    bool remember(const link::control::StateReport& report);
    /// Called when the OPRoS host is gone: the component counts as being in ERROR. [any-thread]
    void peer_lost();
    /// Moves the RTC towards the stored state. Returns true if it has reached this state. [task-thread]
    bool follow();

    /// Sends the values of the active configuration set that the OPRoS component does not have. `known` are the values that
    /// it has, if these are not the last ones sent. [task-thread]
    void send_configuration(const std::vector<link::Property>* known = nullptr);
    /// Sets the component's current ports: shows added ports, and hides those that were removed or have another type.
    /// [task-thread]
    void set_ports(const std::vector<link::Port>& ports);
    /// Tells the OPRoS component the operations of the interfaces that it requires. [task-thread]
    void send_interfaces();
    /// Returns the required service port with this channel name; nullptr if there is none. [any-thread]
    MirrorProvidedPort* find_required(std::string_view channel) const {
        return required_by_channel_.find(channel);
    }
    /// Returns the channels of the connected OutPorts, whose messages wake the execution context. [task-thread]
    std::vector<std::string> listen();

    RTC::ReturnCode_t onInitialize() override;
    RTC::ReturnCode_t onFinalize() override;
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override;
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override;
    RTC::ReturnCode_t onReset(RTC::UniqueId) override;
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override;

  private:
    /// A provided service port: one interface, whose calls cross the link.
    struct Service {
        std::unique_ptr<MirrorRequiredPort> target;
        std::unique_ptr<RTC::CorbaPort> port;
    };
    /// A required service port: calls from across the link go to the connected object.
    struct Consumer {
        std::unique_ptr<MirrorProvidedPort> source;
        std::unique_ptr<RTC::CorbaPort> port;
    };
    struct Output {
        std::unique_ptr<ForwardingOutPort> port;
        link::Port source;
        bool listens = false;
    };
    /// A port that is shown, or was shown and is kept for its return.
    struct ShownPort {
        link::Port source;
        RTC::PortBase* port;
        std::function<void()> add; ///< to this RTC
        bool shown = true;
    };
    Output* output_at(std::size_t index);
    bool add_port(const link::Port& port);
    void show(const link::Port& port, RTC::PortBase& shown, std::function<void()> add);
    void hide_ports_but(const std::vector<link::Port>& ports);
    bool add_data_port(const link::Port& port, const std::string& name);
    bool add_provided_port(const link::Port& port, const std::string& name);
    void add_required_port(const link::Port& port, const std::string& name);
    void add_configuration();
    std::string channel_key(const link::Port& port);
    bool command(std::string_view command, std::chrono::milliseconds timeout);
    bool is_following() const;
    bool must_tell_component() const;
    RTC::LifeCycleState state() const;
    void fail();
    void wake();
    void forward();

    Source source_;
    RTC::ExtTrigExecutionContext* context_ = nullptr; ///< own
    std::deque<ShownPort> shown_ports_;               ///< the ports belong to the members below
    link::PortTypes types_;
    std::vector<std::unique_ptr<OprosInPort>> inputs_;
    std::mutex outputs_mutex_;
    std::mutex forward_mutex_;   ///< one thread at a time forwards the outputs
    std::deque<Output> outputs_; ///< appended to with the mutex held; elements stay
    std::vector<Service> services_;
    std::vector<Consumer> consumers_;
    link::Registry<MirrorProvidedPort> required_by_channel_; ///< of the consumers
    std::vector<std::string> channel_keys_;                  ///< registered with LinkBuffer
    std::map<std::string, std::string> values_;              ///< bound to the configuration parameters
    std::map<std::string, std::string> sent_;                ///< the values that the OPRoS component has

    std::timed_mutex follow_mutex_; ///< held by follow() while it uses the execution context
    mutable std::mutex state_mutex_;
    link::control::ComponentState component_state_{};
    std::uint64_t sequence_ = 0;
    bool peer_is_there_ = false;
    std::atomic<bool> fault_{true}; ///< the component is in ERROR, or its host is gone
    std::atomic<bool> leaving_{false}, finalized_{false};
    std::atomic<bool> wake_pending_{false};
    std::atomic<std::thread::id> follower_{}; ///< the thread that is in follow()
};

} // namespace tandem::interceptor
