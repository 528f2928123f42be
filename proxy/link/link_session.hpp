// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include "shm/segment.hpp"

#include <memory>
#include <optional>
#include <string>

namespace tandem::link {

/// What one generation of the segment is to one half. Whoever works in it holds a pointer, so that it stays
/// mapped.
struct Session {
    Session(std::shared_ptr<shm::Segment> joined, const shm::CallQueueHandle& calls,
            const shm::WaitOptions& wait)
        : segment(std::move(joined)), incoming(calls, wait) {}

    std::shared_ptr<shm::Segment> segment;
    shm::CallServer incoming;                ///< calls of the peer, in our half
    std::optional<shm::CallClient> outgoing; ///< calls to the peer, in its half, once it has published
    bool refused = false;                    ///< the peer's table does not fit: wait for another peer
};

/// What a half says of long messages, under large_name: the bytes that were asked of it by large_kib, and
/// those of its rings' chunks (0 if nobody has asked yet; as many as can be, if it has no rings).
struct LargeMessageLimits {
    std::uint64_t asked, laid_out;
};

/// Names of a half's objects in the segment.
inline const std::string table_name = "table";
inline const std::string calls_name = "calls";
inline const std::string large_name = "large";
inline std::string ring_name(const std::string& port) { return "port " + port; }

} // namespace tandem::link
