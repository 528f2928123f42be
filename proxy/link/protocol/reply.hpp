// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shm/call/call_queue.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::link {

using CallStatus = shm::CallStatus;

/// Whether a call has failed because the peer's process or its component ends, or has ended.
inline bool peer_has_gone(CallStatus status) {
    return status == CallStatus::peer_died || status == CallStatus::shut_down ||
           status == CallStatus::not_ready;
}

/// What a call across the link returned: the results in CDR if the status is ok, otherwise one line of text
/// that describes the failure.
struct Reply {
    CallStatus status = CallStatus::ok;
    std::vector<std::byte> bytes;

    static Reply failure(CallStatus status, std::string_view text) {
        const auto* begin = reinterpret_cast<const std::byte*>(text.data());
        return {status, std::vector<std::byte>(begin, begin + text.size())};
    }
    /// `bytes` read as characters; meaningful for failures only.
    std::string text() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
};

} // namespace tandem::link
