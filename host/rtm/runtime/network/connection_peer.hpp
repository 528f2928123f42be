// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <omniORB4/CORBA.h>
#include <omniORB4/omniInterceptors.h>
#include <optional>
#include <string>
#include <sys/types.h>

namespace RTC {

/// The peer of a CORBA connection that this process has accepted.
struct ConnectionPeer {
    bool is_on_this_machine;
    std::optional<uid_t> user; ///< on this machine; empty if the kernel does not say
    std::string text;          ///< for messages: `user alice (1001) at 127.0.0.1:4711`
};

/// Identifies the peer: by the credentials of a Unix socket or, for a TCP connection within this machine, by the owner
/// of the socket at the other end. [ORB thread]
ConnectionPeer find_connection_peer(omni::omniInterceptors::serverAcceptConnection_T::info_T& connection);

} // namespace RTC
