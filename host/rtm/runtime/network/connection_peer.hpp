// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <omniORB4/CORBA.h>
#include <omniORB4/omniInterceptors.h>
#include <optional>
#include <string>
#include <sys/types.h>

namespace RTC {

/// Who is at the other end of a CORBA connection that this process has accepted.
struct ConnectionPeer {
    bool is_on_this_machine;
    std::optional<uid_t> user; ///< on this machine; empty if the kernel does not say
    std::string text;          ///< for messages: `user alice (1001) at 127.0.0.1:4711`
};

/// Finds out who has connected: by the credentials of a Unix socket, or by the owner of the TCP socket at the other end of a
/// connection within this machine. [ORB thread]
ConnectionPeer find_connection_peer(omni::omniInterceptors::serverAcceptConnection_T::info_T& connection);

} // namespace RTC
