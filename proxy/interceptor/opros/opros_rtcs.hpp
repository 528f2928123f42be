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

/// The RTCs that show the OPRoS components that the peer shares. An RTC is created when the component's state is first
/// reported. It is removed when the component is destroyed, or is no longer shared with the same ports. Without a peer the
/// RTCs are in ERROR.
class OprosRtcs {
  public:
    /// `owner` is InterceptorComp's name, for messages. `connections_changed` is called in the task thread when
    /// listened_channels() may have changed. The references must outlive this object.
    OprosRtcs(std::string owner, RTC::Manager& manager, link::Link& link, std::string link_name,
              std::chrono::milliseconds call_timeout, std::function<void()> connections_changed);
    ~OprosRtcs() { close(); }
    OprosRtcs(const OprosRtcs&) = delete;
    OprosRtcs& operator=(const OprosRtcs&) = delete;

    /// Sets what the peer shares: a new peer (`comes`), or one that has changed its ports. [supervisor-thread]
    void set_peer_table(const link::PortTable& table, bool comes);
    /// Executes control::state. Throws link::LinkError for a damaged report. [worker-thread]
    void receive_state(const link::Request& request);

    /// Calls the service that a component requires. Failures such as "not ready" or "no such port" are replies, too.
    /// [worker-thread]
    link::Reply serve(const link::Request& request);

    // [task-thread]
    void peer_connected();
    void peer_lost();
    /// Called when the components have got other ports while the link is up.
    void update_ports();
    /// Returns the connected ports, for whose messages the peer must ring the doorbell.
    std::vector<std::string> listened_channels();

    /// Removes all RTCs. Call it after Link::close(), when the link's threads are not in this object. [manager's thread]
    void close();

  private:
    /// Keeps the servant alive while this process uses it.
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

    std::mutex mutex_; ///< guards the members below; not held while an RTC is used
    link::PortTable table_;
    std::map<std::string, link::control::StateReport> reports_; ///< the newest of each, of this session
    std::map<std::string, std::shared_ptr<Entry>> rtcs_;        ///< by name; changed only in the task thread
};

} // namespace tandem::interceptor
