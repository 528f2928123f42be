// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/data_mirrors.hpp"
#include "proxy/interceptor/drive/failure_reports.hpp"
#include "proxy/interceptor/drive/rtc_activation.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/interceptor/manage/built_in_service.hpp"
#include "proxy/interceptor/opros/opros_rtcs.hpp"
#include "proxy/interceptor/remote_rtcs.hpp"
#include "proxy/interceptor/service_mirrors.hpp"
#include "proxy/interceptor/settings.hpp"
#include "proxy/interceptor/shared_ports.hpp"
#include "proxy/link/link.hpp"

#include <memory>
#include <optional>
#include <span>
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

    /// Ends the component. If a thread of the link calls this, a thread of the manager ends it a little later, because
    /// onFinalize() waits for the link's threads.
    RTC::ReturnCode_t exit() override;
    RTC::ReturnCode_t onInitialize() override;
    RTC::ReturnCode_t onFinalize() override;
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override { return RTC::RTC_OK; }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override { return RTC::RTC_OK; }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override { return RTC::RTC_OK; }

  private:
    void share_rtc_ports();
    void report_useless_parameters(const link::PortTable& table);
    void create_parts(const link::PortTable& table);
    void drive(RTC::RTObject_impl& rtc);
    void follow_recovery();
    void report_deactivation(const std::string& rtc) const;
    RemoteRtcs::Events follow_remote_rtcs();
    link::LinkOptions link_options() const;
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

    Settings settings_;
    std::unique_ptr<link::Link> link_; ///< all parts below use it
    std::unique_ptr<FailureReports> failures_;
    std::unique_ptr<RemoteRtcs> remote_rtcs_;
    std::unique_ptr<RtcActivation> activation_;
    std::unique_ptr<DataMirrors> data_mirrors_;
    std::unique_ptr<ServiceMirrors> service_mirrors_;
    std::unique_ptr<OprosRtcs> opros_rtcs_;
    std::unique_ptr<SharedPorts> shared_ports_; ///< changes the mirrors
    std::vector<BuiltInService> built_in_services_;

    RTC::TimedDoubleSeq link_state_;
    RTC::OutPort<RTC::TimedDoubleSeq> link_state_out_;
    std::uint64_t link_state_sequence_ = 0;
    RTC::TimedString missed_deadline_;
    RTC::OutPort<RTC::TimedString> missed_deadline_out_;
};

} // namespace tandem::interceptor
