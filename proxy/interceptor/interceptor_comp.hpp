// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/drive/failure_reports.hpp"
#include "proxy/interceptor/drive/rtc_activation.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/interceptor/manage/built_in_service.hpp"
#include "proxy/interceptor/opros/opros_rtcs.hpp"
#include "proxy/interceptor/remote_rtcs.hpp"
#include "proxy/interceptor/rtc_port.hpp"
#include "proxy/interceptor/rtc_port_watcher.hpp"
#include "proxy/interceptor/service/mirror_provided_port.hpp"
#include "proxy/interceptor/service/mirror_required_port.hpp"
#include "proxy/interceptor/settings.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/protocol/port_types.hpp"
#include "proxy/link/registry.hpp"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// The RTM side of the proxy: an ordinary RTC that shares the ports of other RTCs with AdaptorComp. It activates,
/// deactivates and resets these RTCs when AdaptorComp asks for it, and deactivates them if the peer dies. It shows the
/// OPRoS components that AdaptorComp shares as RTCs of this manager while it exists.
///
/// Its OutPort `linkState` sends {time [s, CLOCK_MONOTONIC], sequence number, 1 up / 0 down} when the link comes up or goes
/// down. Its OutPort `missedDeadline` sends the name of a port whose sender was silent for longer than its deadline_ms.
class InterceptorComp final : public RTC::DataFlowComponentBase, private link::LinkHandler {
  public:
    explicit InterceptorComp(RTC::Manager* manager);
    ~InterceptorComp() override;

    RTC::ReturnCode_t onInitialize() override;
    RTC::ReturnCode_t onFinalize() override;
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override { return RTC::RTC_OK; }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override { return RTC::RTC_OK; }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override { return RTC::RTC_OK; }

  private:
    void share_rtc_ports();
    void report_useless_parameters();
    void create_mirror_ports(const std::vector<RtcPort>& ports);
    void set_policy(const RtcPort&);
    void create_data_mirror(const RtcPort&);
    void create_event_mirror(const RtcPort&);
    void create_service_mirror(const RtcPort&);
    /// Properties of a connection by name.
    using Properties = std::vector<std::pair<const char*, std::string>>;
    void connect(RTC::PortBase& mirror, const RtcPort& port, const std::string& name,
                 const Properties& properties);
    /// The mirror of a data port of one type.
    struct DataMirror {
        link::Port entry;
        std::unique_ptr<RTC::PortBase> port;
        std::function<void()> forward{}; ///< called when messages have come; none: the RTC reads them itself
        bool shown = true;               ///< this component has the port
    };
    void add_mirror(DataMirror mirror);
    void show(DataMirror& mirror);
    void hide(DataMirror& mirror);
    DataMirror* find_data_mirror(const link::Port& entry);
    RTC::PortBase* find_mirror(const RtcPort& port);
    void connect_port(const RtcPort& port);
    void connect_remote(RTC::PortBase& mirror, const RtcPort& port);
    void watch_ports(RTC::RTObject_impl& rtc);
    void port_added(RTC::RTObject_impl& rtc, const std::string& name);
    void share_again(RtcPort& shared, RtcPort port);
    void change_type(RtcPort& shared, const RtcPort& port);
    void change_interface(RtcPort& shared, const RtcPort& port);
    void share_new_ports(std::vector<RtcPort> ports);
    void port_removed(const std::string& component, const std::string& name);
    void end_sharing(const RtcPort& shared);
    RemoteRtcs::Events follow_remote_rtcs();
    void follow_remote_rtc(const std::string& component, std::vector<RtcPort> ports);
    void publish_ports();
    void drive(RTC::RTObject_impl& rtc);
    void leave_out(const std::string& reason);
    void disconnect_all();

    // LinkHandler, in the link's threads.
    std::string check_peer_ports(link::PortTable&) override;
    void link_state_changed(bool up) override;
    void deadline_missed(const std::string& port) override;
    void peer_connected() override;
    void peer_disconnected() override;
    void peer_ports_changed() override;
    link::Reply serve(const link::Request&) override;
    std::optional<link::ReplyView> serve_known(const link::KnownRequest&, wire::MessageBuffer&) override;
    link::Reply execute_command(const link::Request&);

    /// Returns an empty string or an error of one line.
    std::string bind(std::span<const std::byte> arguments);

    void publish_listened_channels();
    link::LinkOptions link_options() const;
    std::string channel_key(const link::Port& port);

    Settings settings_;
    std::unique_ptr<link::Link> link_;
    std::unique_ptr<OprosRtcs> opros_rtcs_;
    std::unique_ptr<FailureReports> failures_;
    std::unique_ptr<RemoteRtcs> remote_rtcs_;
    std::unique_ptr<RtcActivation> activation_;

    // The mirrors: created by share_rtc_ports(), then changed in the task thread until disconnect_all(). A mirror is kept
    // when its port is removed, because the port may be added again. A port with another type gets another mirror.
    std::vector<RtcPort> shared_ports_;
    link::PortTable table_; ///< the table for the peer: those of shared_ports_ that exist now
    std::vector<std::unique_ptr<RtcPortWatcher>> port_watchers_;
    std::multimap<std::string, DataMirror> data_ports_; ///< by name
    link::PortTypes types_;
    std::map<std::string, std::unique_ptr<RTC::CorbaPort>> service_ports_;
    std::vector<std::unique_ptr<MirrorRequiredPort>> required_;
    std::vector<std::unique_ptr<MirrorProvidedPort>> provided_;
    link::Registry<MirrorRequiredPort> required_by_name_;
    link::Registry<MirrorProvidedPort> provided_by_name_;
    std::vector<BuiltInService> built_in_services_;
    std::mutex channel_keys_mutex_;
    std::set<std::string> channel_keys_;  ///< registered with LinkBuffer
    std::set<std::string> channel_ports_; ///< the names of their ports

    RTC::TimedDoubleSeq link_state_;
    RTC::OutPort<RTC::TimedDoubleSeq> link_state_out_;
    std::uint64_t link_state_sequence_ = 0;
    RTC::TimedString missed_deadline_;
    RTC::OutPort<RTC::TimedString> missed_deadline_out_;
};

} // namespace tandem::interceptor
