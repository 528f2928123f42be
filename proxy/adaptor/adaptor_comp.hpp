// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/mirror_in_port.hpp"
#include "proxy/adaptor/mirror_out_port.hpp"
#include "proxy/adaptor/mirror_provided_port.hpp"
#include "proxy/adaptor/mirror_required_port.hpp"
#include "proxy/adaptor/settings.hpp"
#include "proxy/link/link.hpp"

#include <Component.h>
#include <OutputDataPort.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// The OPRoS half of the proxy: an ordinary OPRoS component that grows the ports of the RTC behind
/// InterceptorComp. Starting and stopping it activates and deactivates that RTC; an RTC in ERROR puts it in
/// ERROR. `linkState` gives {stamp [s], sequence, 1 up / 0 down} whenever the peer comes or goes, and at
/// start.
class AdaptorComp final : public Component, private link::LinkHandler {
  public:
    AdaptorComp();
    ~AdaptorComp() override;

  protected:
    ReturnType onInitialize() override;
    ReturnType onStart() override;
    ReturnType onStop() override;
    ReturnType onReset() override;
    ReturnType onError() override;
    ReturnType onRecover() override;
    ReturnType onDestroy() override;
    ReturnType onEvent(Event*) override { return OPROS_SUCCESS; }
    ReturnType onExecute() override { return OPROS_SUCCESS; }
    ReturnType onUpdated() override { return OPROS_SUCCESS; }
    ReturnType onPeriodChanged() override { return OPROS_SUCCESS; }

  private:
    std::string check_peer_ports(const link::PortTable&) override;
    void link_state_changed(bool up) override;
    void peer_connected() override;
    void peer_disconnected() override;
    link::Reply serve(const link::Request&) override;

    void create_mirror_ports();
    void create_mirror_port(const link::Port&);
    MirrorRequiredPort* find_required_port(std::string_view name);
    ReturnType drive(std::string_view command);
    std::string publish_bindings();
    std::chrono::milliseconds timeout_of(std::string_view command) const;
    link::Reply control(std::string_view command, std::span<const std::byte> arguments = {});
    void publish_link_state();

    Settings settings_;
    std::unique_ptr<link::Link> link_;
    std::mutex mutex_; ///< table_, mirror_ports_created_, required_ while it grows
    link::PortTable table_;
    bool mirror_ports_created_ = false;
    std::atomic<bool> started_{false}, rtc_failed_{false};

    std::vector<std::unique_ptr<MirrorInPort>> inputs_;
    std::vector<std::unique_ptr<MirrorOutPort>> outputs_;
    std::vector<MirrorRequiredPort*> required_; ///< service ports belong to the component, which deletes them
    std::mutex link_state_mutex_;
    OutputDataPort<std::vector<double>> link_state_;
    std::uint64_t link_state_sequence_ = 0;
};

} // namespace tandem::adaptor
