// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/data_mirrors.hpp"
#include "proxy/interceptor/drive/rtc_activation.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/interceptor/rtc_port.hpp"
#include "proxy/interceptor/rtc_port_watcher.hpp"
#include "proxy/interceptor/service_mirrors.hpp"
#include "proxy/link/link.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// The ports of RTCs that the link shares. Follows ports that the RTCs add and remove: makes or connects their mirrors, and
/// publishes a new port table.
class SharedPorts {
  public:
    /// `owner` has the mirrors. `listened_changed` is called in the task thread when DataMirrors::listened_ports() may have
    /// changed. The references must outlive this object, which is destroyed after Link::close().
    SharedPorts(RTC::RTObject_impl& owner, link::Link& link, DataMirrors& data, ServiceMirrors& services,
                const RtcActivation& activation, std::function<void()> listened_changed);

    /// Makes mirrors of the ports and connects them. `shared.table` is the link's port table. Throws std::runtime_error if
    /// a port cannot be used and `strict` is set. [before Link::open()]
    void share(const SharedRtcs& shared);
    /// Follows the ports that an RTC of this process adds and removes from now on. [before Link::open()]
    void watch(RTC::RTObject_impl& rtc);
    /// Follows an RTC of another process. `ports`: its current ports; empty if it has gone. [task-thread]
    void follow(const std::string& component, std::vector<RtcPort> ports);

  private:
    void create_mirrors(const std::vector<RtcPort>& ports);
    void connect(const RtcPort& port);
    void disconnect(const RtcPort& port);
    void activate_like_owner(const RtcPort& port);

    // [task-thread]
    void port_added(RTC::RTObject_impl& rtc, const std::string& name);
    void port_removed(const std::string& component, const std::string& name);
    void share_again(RtcPort& shared, RtcPort port);
    void change_type(RtcPort& shared, const RtcPort& port);
    void change_interface(RtcPort& shared, const RtcPort& port);
    void share_new(std::vector<RtcPort> ports);
    void add_rtc_name_if_taken(RtcPort& port) const;
    void end_sharing(const RtcPort& shared);

    RTC::RTObject_impl& owner_;
    link::Link& link_;
    DataMirrors& data_;
    ServiceMirrors& services_;
    const RtcActivation& activation_;
    const std::function<void()> listened_changed_;
    // Set by share(), then changed in the task thread.
    std::vector<RtcPort> ports_; ///< including those that the RTCs have removed
    link::PortTable table_;      ///< the table for the peer: those of ports_ that exist now
    std::vector<std::unique_ptr<RtcPortWatcher>> watchers_;
};

} // namespace tandem::interceptor
