// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/mirror_provided_port.hpp"
#include "proxy/interceptor/mirror_required_port.hpp"
#include "proxy/interceptor/rtc_driver.hpp"
#include "proxy/interceptor/rtc_port.hpp"
#include "proxy/interceptor/settings.hpp"
#include "proxy/link/link.hpp"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// The RTM half of the proxy: an ordinary RTC that shares the ports of another RTC of its manager with
/// AdaptorComp, and activates, deactivates and resets it as AdaptorComp is told. Its OutPort `linkState`
/// gives {stamp [s], sequence, 1 up / 0 down} when the peer comes or goes. A peer that dies leaves the
/// RTC deactivated.
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
    void mirror_data_port(const RtcPort&);
    void mirror_service_port(const RtcPort&);
    void connect(RTC::PortBase& mine, RTC::PortService_ptr theirs, const std::string& channel_key);
    void release();

    std::string check_peer_ports(const link::PortTable&) override { return ""; }
    void link_state_changed(bool up) override;
    void peer_connected() override;
    void peer_disconnected() override;
    link::Reply serve(const link::Request&) override;
    link::Reply serve_control(const link::Request&);
    std::string bind(std::span<const std::byte> arguments);
    void report_rtc_error();
    std::string activate();

    std::string channel_key(const std::string& port) const;

    Settings settings_;
    std::unique_ptr<link::Link> link_;
    std::unique_ptr<RtcDriver> driver_, own_driver_;
    std::atomic<bool> activated_by_link_{false};
    std::atomic<bool> failed_{false}; ///< the RTC went to ERROR and the peer does not know yet

    std::vector<std::unique_ptr<RTC::PortBase>> data_ports_;
    std::map<std::string, std::unique_ptr<RTC::CorbaPort>> service_ports_;
    std::vector<std::unique_ptr<MirrorRequiredPort>> providers_;
    std::vector<std::unique_ptr<MirrorProvidedPort>> consumers_;
    std::vector<std::string> channel_keys_;

    RTC::TimedDoubleSeq link_state_;
    RTC::OutPort<RTC::TimedDoubleSeq> link_state_out_;
    std::uint64_t link_state_sequence_ = 0;
};

} // namespace tandem::interceptor
