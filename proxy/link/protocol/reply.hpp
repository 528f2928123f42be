// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "shm/call/call_queue.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::link {

using CallStatus = shm::CallStatus;

/// Returns true if a call failed because the peer's process or component is ending or has ended.
inline bool peer_has_gone(CallStatus status) {
    return status == CallStatus::peer_died || status == CallStatus::shut_down ||
           status == CallStatus::not_ready;
}

/// The result of a call across the link: results in CDR if the status is ok, otherwise one line of text about the
/// failure.
struct Reply {
    CallStatus status = CallStatus::ok;
    std::vector<std::byte> bytes;

    static Reply failure(CallStatus status, std::string_view text) {
        const auto* begin = reinterpret_cast<const std::byte*>(text.data());
        return {status, std::vector<std::byte>(begin, begin + text.size())};
    }
    /// Returns `bytes` as characters. Only meaningful for failures.
    std::string text() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
};

/// A reply in the caller's memory. A short one needs no allocation.
struct ReplyView {
    CallStatus status = CallStatus::ok;
    std::span<const std::byte> bytes;

    Reply copy() const { return {status, {bytes.begin(), bytes.end()}}; }
};
/// Copies a reply into `memory`. The result is valid until `memory` is used again.
inline ReplyView copy_to(wire::MessageBuffer& memory, const Reply& reply) {
    const auto bytes = memory.room_for(reply.bytes.size());
    wire::copy_block(bytes.data(), reply.bytes.data(), bytes.size());
    return {reply.status, bytes};
}

} // namespace tandem::link
