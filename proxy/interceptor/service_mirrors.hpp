// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/interceptor/port_connector.hpp"
#include "proxy/interceptor/rtc_port.hpp"
#include "proxy/interceptor/service/mirror_provided_port.hpp"
#include "proxy/interceptor/service/mirror_required_port.hpp"
#include "proxy/interceptor/settings.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/registry.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::interceptor {

/// The mirrors of the service ports of the RTCs that the link shares, as ports of InterceptorComp, and of their
/// interfaces. The mirror of an interface is kept when the interface is removed, for calls under way, and in case the
/// interface comes back. [one thread at a time] unless stated otherwise.
class ServiceMirrors {
  public:
    /// `owner` has the mirrors. The references must outlive this object.
    ServiceMirrors(RTC::RTObject_impl& owner, link::Link& link, const Settings& settings);

    /// Makes mirrors of the service ports among `ports`, as ports of the owner.
    void create(const std::vector<RtcPort>& ports);
    /// Makes another mirror of the service port, with the interfaces that `ports` have of it.
    void replace(const std::string& service_port, const std::vector<RtcPort>& ports);
    /// Connects the service port with its mirror. A service port with several interfaces is connected once.
    void connect(const RtcPort& port);
    /// Ends all connections of the service port's mirror.
    void disconnect(const std::string& service_port);
    /// Lets the service port's mirror be called, as the activation of the owner does.
    void activate(const std::string& service_port);

    /// Returns the mirror of the interface of this name, or with this link::port_id(); nullptr if there is none.
    /// [any-thread]
    MirrorProvidedPort* find_provided(std::string_view name) const { return provided_by_name_.find(name); }
    MirrorProvidedPort* find_provided(std::uint64_t id) const { return provided_by_name_.find(id); }
    MirrorRequiredPort* find_required(std::string_view name) const { return required_by_name_.find(name); }
    /// Called when the peer has gone: nobody provides the required interfaces any more.
    void unbind_required();

    /// Ends all connections. Call it after Link::close(). The mirrors stay until this object is destroyed, because they are
    /// ports of the owner.
    void close();

  private:
    void create_interface(const RtcPort& port);

    RTC::RTObject_impl& owner_;
    link::Link& link_;
    const Settings& settings_;
    PortConnector connector_;
    std::map<std::string, std::unique_ptr<RTC::CorbaPort>> ports_;
    std::vector<std::unique_ptr<MirrorRequiredPort>> required_;
    std::vector<std::unique_ptr<MirrorProvidedPort>> provided_;
    link::Registry<MirrorRequiredPort> required_by_name_;
    link::Registry<MirrorProvidedPort> provided_by_name_;
};

} // namespace tandem::interceptor
