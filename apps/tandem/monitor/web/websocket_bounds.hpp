// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include <chrono>
#include <cstddef>

namespace tandem::monitor {

/// Before the handshake. A client that does not answer a ping for `idle`, takes more than 5 s for the handshake, or sends a
/// message of more than `max_message` bytes is disconnected.
inline void set_bounds(boost::beast::websocket::stream<boost::beast::tcp_stream>& stream,
                       std::chrono::seconds idle, std::size_t max_message) {
    boost::beast::websocket::stream_base::timeout bounds{};
    bounds.handshake_timeout = std::chrono::seconds(5);
    bounds.idle_timeout = idle;
    bounds.keep_alive_pings = true;
    stream.set_option(bounds);
    stream.read_message_max(max_message);
}

} // namespace tandem::monitor
