// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/interceptor/port_connector.hpp"
#include "proxy/interceptor/rtc_port.hpp"
#include "proxy/interceptor/settings.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/protocol/port_types.hpp"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// The mirrors of the data ports and EventInPorts of the RTCs that the link shares, as ports of InterceptorComp. A mirror
/// is kept when its port is removed, because the port may be added again. A port with another type gets another mirror.
/// [one thread at a time] unless stated otherwise.
class DataMirrors {
  public:
    /// `owner` has the mirrors; its parameters set their policies. The references must outlive this object.
    DataMirrors(RTC::RTObject_impl& owner, link::Link& link, const Settings& settings);

    /// Makes a mirror of the port, as a port of the owner. Leaves out a port whose type cannot cross; see PortConnector.
    void create(const RtcPort& port);
    /// Gives the owner the earlier mirror of exactly this port again, without messages that have come since. Returns
    /// false if there was none.
    bool restore(const link::Port& port);
    /// Takes the port's mirror from the owner, if there is one.
    void hide(const link::Port& port);
    /// Connects the port with its mirror, if it has one. An EventInPort has one connection for each of its events.
    void connect(const RtcPort& port);
    /// Ends all connections of the port's mirror.
    void disconnect(const link::Port& port);
    /// Gives the port's channel the policy for which the owner's parameters ask.
    void set_policy(const link::Port& port);

    /// Returns the ports whose messages are handed over when they come.
    std::vector<std::string> listened_ports() const;
    /// Returns the first port of the table that has the name of a mirrored port; nullptr if there is none. [any-thread]
    const link::Port* find_same_name(const link::PortTable& table) const;

    /// Ends all connections. Call it after Link::close(). The mirrors stay until this object is destroyed, because they are
    /// ports of the owner.
    void close();

  private:
    /// The mirror of a data port of one type.
    struct Mirror {
        link::Port entry;
        std::unique_ptr<RTC::PortBase> port;
        std::function<void()> forward{}; ///< called when messages have come; none: the RTC reads them itself
        bool shown = true;               ///< the owner has the port
    };
    void create_data_mirror(const RtcPort& port);
    void create_event_mirror(const RtcPort& port);
    std::string channel_key(const link::Port& port);
    void add(Mirror mirror);
    void show(Mirror& mirror);
    Mirror* find(const link::Port& port);
    void connect_events(Mirror& mirror, const RtcPort& port);

    RTC::RTObject_impl& owner_;
    link::Link& link_;
    const Settings& settings_;
    PortConnector connector_;
    std::multimap<std::string, Mirror> mirrors_; ///< by name
    link::PortTypes types_;
    mutable std::mutex channel_keys_mutex_;
    std::set<std::string> channel_keys_;  ///< registered with LinkBuffer
    std::set<std::string> channel_ports_; ///< the names of their ports
};

} // namespace tandem::interceptor
