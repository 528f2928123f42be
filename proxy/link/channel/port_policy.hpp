// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/setting.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

namespace tandem::link {

/// The user's settings for one data port across a link, except its type.
struct PortPolicy {
    bool keep_last = false; ///< `keep_last`, of the sender: a newly connected peer gets the last message
    /// `wait_ms`, of the sender: how long a message waits for room before it is dropped. With 0, the reader drops the
    /// oldest message (ChannelReader::set_depth), or, with `refuse`, the new one is dropped.
    std::chrono::milliseconds wait{0};
    bool refuse = false;
    std::uint32_t length = 0; ///< messages that fit into the receiver's queue; 0: the reader decides
    /// `deadline_ms`, of the receiver: the longest time without a message; 0: none.
    std::chrono::milliseconds deadline{0};

    /// Returns true if a message may have to wait for the reader, or may be dropped in favour of older ones.
    bool holds_back() const { return wait.count() != 0 || refuse; }
};

constexpr std::chrono::milliseconds max_wait{1000}; ///< maximum of wait_ms: unbinding a port may wait as long

/// Reads the policy of a port from the settings `keep_last.PORT`, or `keep_last` for all ports, and so on.
/// `find(name)` returns a setting's text, or an empty string. Throws std::runtime_error, one line.
template <class Find>
PortPolicy read_port_policy(const char* kind, const std::string& port, Find&& find) {
    const auto effective = [&](const std::string& name) {
        const std::string own = name + "." + port;
        return find(own).empty() ? name : own;
    };
    const auto milliseconds = [&](const std::string& all) {
        const std::string name = effective(all), value = find(name);
        if (value == "0") return std::chrono::milliseconds(0); // for one port, while others have more
        return std::chrono::milliseconds(static_cast<long>(parse_positive_number(kind, name, value, 0)));
    };
    const std::string keep_last = effective("keep_last");
    PortPolicy policy;
    policy.keep_last = parse_flag(kind, keep_last, find(keep_last));
    policy.wait = std::min(milliseconds("wait_ms"), max_wait);
    policy.deadline = milliseconds("deadline_ms");
    return policy;
}

/// Adds the queue of the receiving port to the policy. A wait set by the user takes precedence over the queue's wait.
inline void add_queue_policy(const QueuePolicy& queue, PortPolicy& policy) {
    policy.length = queue.length;
    policy.refuse = queue.full != QueuePolicy::Full::overwrite; // after a wait, if there is one
    if (queue.full == QueuePolicy::Full::wait && policy.wait.count() == 0)
        policy.wait = std::min(std::chrono::milliseconds(queue.wait_ms), max_wait);
}

} // namespace tandem::link
