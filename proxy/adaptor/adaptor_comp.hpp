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
/// ERROR. `linkState` gives {stamp [s], sequence, 1 up / 0 down} whenever the partner comes or goes, and at
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
    std::string accept(const link::PortTable&) override;
    void link_changed(bool up) override;
    void partner_came() override;
    void partner_went() override;
    link::Answer serve(const link::Request&) override;

    void grow_ports();
    void grow_port(const link::Port&);
    MirroredRequired* find_required(std::string_view name);
    ReturnType drive(std::string_view verb);
    std::string tell_bindings();
    std::chrono::milliseconds bound_of(std::string_view verb) const;
    link::Answer control(std::string_view verb, std::span<const std::byte> arguments = {});
    void push_link_state();

    Settings settings_;
    std::unique_ptr<link::Link> link_;
    std::mutex mutex_; ///< table_, grown_, required_ while it grows
    link::PortTable table_;
    bool grown_ = false;
    std::atomic<bool> started_{false}, rtc_failed_{false};

    std::vector<std::unique_ptr<MirroredInput>> inputs_;
    std::vector<std::unique_ptr<MirroredOutput>> outputs_;
    std::vector<MirroredRequired*> required_; ///< service ports belong to the component, which deletes them
    std::mutex link_state_mutex_;
    OutputDataPort<std::vector<double>> link_state_;
    std::uint64_t link_state_sequence_ = 0;
};

} // namespace tandem::adaptor
