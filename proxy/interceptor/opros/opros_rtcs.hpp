// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/interceptor/opros/opros_rtc.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/link/protocol/request.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// The RTCs that show the OPRoS components that the peer shares. One is created when the component's state is first
/// reported, and removed when the component is destroyed, or no longer shared with the same ports. While the peer is
/// not there they are in ERROR.
class OprosRtcs {
  public:
    /// `owner` is InterceptorComp's name, for messages; `connections_changed` is called in the task thread when
    /// listened_channels() may have become others. The references must outlive this object.
    OprosRtcs(std::string owner, RTC::Manager& manager, link::Link& link, std::string link_name,
              std::chrono::milliseconds call_timeout, std::function<void()> connections_changed);
    ~OprosRtcs() { close(); }
    OprosRtcs(const OprosRtcs&) = delete;
    OprosRtcs& operator=(const OprosRtcs&) = delete;

    /// What the peer shares: one that comes, or one that has added ports. [supervisor-thread]
    void set_peer_table(const link::PortTable& table, bool comes);
    /// Executes control::state. Throws link::LinkError for a damaged report. [worker-thread]
    void receive_state(const link::Request& request);

    /// Calls the service that a component requires; not ready, or no such port, is a reply, too. [worker-thread]
    link::Reply serve(const link::Request& request);

    // [task-thread]
    void peer_connected();
    void peer_lost();
    /// The components have got other ports while the peer is there.
    void update_ports();
    /// The ports that somebody is connected to, for whose messages the peer has to ring the doorbell.
    std::vector<std::string> listened_channels();

    /// Removes all. After Link::close(): the link's threads are not in this object. [manager's thread]
    void close();

  private:
    /// Keeps the servant alive while this process still uses it.
    struct Entry {
        explicit Entry(OprosRtc& created) : rtc(&created) { rtc->_add_ref(); }
        ~Entry() { rtc->_remove_ref(); }
        Entry(const Entry&) = delete;
        Entry& operator=(const Entry&) = delete;
        OprosRtc* const rtc;
    };
    OprosRtc* find(const std::string& name);
    void follow(const std::string& name);
    OprosRtc* create(const std::string& name);
    void remove(const std::string& name);
    void forget_finalized();

    const std::string owner_;
    RTC::Manager& manager_;
    link::Link& link_;
    const std::string link_name_;
    const std::chrono::milliseconds call_timeout_;
    const std::function<void()> connections_changed_;

    std::mutex mutex_; ///< the members below; not held while an RTC is used
    link::PortTable table_;
    std::map<std::string, link::control::StateReport> reports_; ///< the newest of each, of this session
    std::map<std::string, std::shared_ptr<Entry>> rtcs_;        ///< by name; changed in the task thread only
};

} // namespace tandem::interceptor
