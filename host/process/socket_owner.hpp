// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <sys/types.h>

namespace tandem::process {

/// One end of a TCP connection.
struct TcpEnd {
    int family = AF_UNSPEC;                 ///< AF_INET also for an IPv4 address within an IPv6 address
    std::array<std::uint32_t, 4> address{}; ///< in network order; IPv4: the first word
    std::uint16_t port = 0;                 ///< in network order
};

/// Converts an address of IPv4 or IPv6. Returns AF_UNSPEC for any other family.
TcpEnd make_tcp_end(const sockaddr& address);

/// Returns the user who owns the socket that connected from `theirs` to `ours`, as sock_diag(7) reports it. Returns
/// nothing if the socket is not in this network namespace or is already closed. Takes up to 1 s. [any-thread]
std::optional<uid_t> find_socket_owner(const TcpEnd& theirs, const TcpEnd& ours);

/// Returns a user's name and number for messages: `user alice (1001)`, or `an unknown user`. [any-thread]
std::string describe_user(std::optional<uid_t> user);

} // namespace tandem::process
