// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/port_table.hpp"
#include "proxy/link/request.hpp"
#include "shm/call/call_queue.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace tandem::link {

using CallStatus = shm::CallStatus;

/// What came of a call across the link: results in CDR when ok, otherwise one line of text.
struct Reply {
    CallStatus status = CallStatus::ok;
    std::vector<std::byte> bytes;

    static Reply failure(CallStatus status, std::string_view text) {
        const auto* begin = reinterpret_cast<const std::byte*>(text.data());
        return {status, std::vector<std::byte>(begin, begin + text.size())};
    }
    std::string text() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
};

/// What a half does when its peer comes, goes and calls.
class LinkHandler {
  public:
    virtual ~LinkHandler() = default;
    /// The peer's table; the result is empty, or one line why it does not fit. [link-thread, do not wait]
    virtual std::string check_peer_ports(const PortTable& peer) = 0;
    /// Data flow from now on, or no more. [link-thread, do not wait]
    virtual void link_state_changed(bool up) = 0;
    /// After link_state_changed(true) / (false), where calls may be made and waited for. [task-thread]
    virtual void peer_connected() = 0;
    virtual void peer_disconnected() = 0;
    /// A call of the peer. [worker-thread]
    virtual Reply serve(const Request&) = 0;
};

} // namespace tandem::link
