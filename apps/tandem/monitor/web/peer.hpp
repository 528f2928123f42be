// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <boost/asio/ip/tcp.hpp>

#include <optional>
#include <string>
#include <sys/types.h>

namespace tandem::monitor {

/// The other end of a connection.
struct Peer {
    std::string
        key; ///< equal for all connections of a user of this machine, or of an address of another machine
    bool is_local = false;
    std::optional<uid_t> user; ///< of this machine, if the kernel knows it
    std::string address;       ///< with the port; empty: the client has left
};

/// Identifies the peer of a connected socket. Connections of this machine count by user, those of other machines by
/// IPv4 address or by IPv6 network of 64 bits. Connections of this machine whose user is unknown count together.
Peer find_peer(const boost::asio::ip::tcp::socket& socket);

/// Returns text for messages: `user alice (1001) at 127.0.0.1:4711`. Asks the user database, which may be slow.
std::string describe(const Peer& peer);

/// Returns the address without a scope, and an IPv4 address that is within an IPv6 address as the IPv4 address.
boost::asio::ip::address plain_address(const boost::asio::ip::address& address);

} // namespace tandem::monitor
