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
struct Answer {
    CallStatus status = CallStatus::ok;
    std::vector<std::byte> bytes;

    static Answer failure(CallStatus status, std::string_view text) {
        const auto* begin = reinterpret_cast<const std::byte*>(text.data());
        return {status, std::vector<std::byte>(begin, begin + text.size())};
    }
    std::string text() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
};

/// What a half does when its partner comes, goes and calls.
class LinkHandler {
  public:
    virtual ~LinkHandler() = default;
    /// The partner's table; the answer is empty, or one line why it does not fit. [link-thread, do not wait]
    virtual std::string accept(const PortTable& partner) = 0;
    /// Data flow from now on, or no more. [link-thread, do not wait]
    virtual void link_changed(bool up) = 0;
    /// After link_changed(true) / (false), where calls may be made and waited for. [task-thread]
    virtual void partner_came() = 0;
    virtual void partner_went() = 0;
    /// A call of the partner. [worker-thread]
    virtual Answer serve(const Request&) = 0;
};

} // namespace tandem::link
