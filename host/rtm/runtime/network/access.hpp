// SPDX-License-Identifier: Apache-2.0
// Access control for the objects of this process by CORBA.
#pragma once
#include <coil/Properties.h>
#include <string>
#include <vector>

namespace omni {
class giopStrand;
}

namespace RTC {

/// Permissions from rtc.conf, in addition to those that processes of this user and of root always have.
struct AccessRules {
    std::vector<std::string> users; ///< users of this machine with the same rights; names or numbers
    std::vector<std::string>
        hosts; ///< other machines that may connect, as HostRanges takes them; empty: see control_access()
    bool remote_load = false;     ///< other machines may load code
    bool remote_shutdown = false; ///< other machines may end this process and its components
};

/// Reads corba.permitted_users, corba.permitted_hosts, manager.modules.remote_load and manager.remote_shutdown.
AccessRules read_access_rules(const coil::Properties& config);

/// From now on refuses connections of other users of this machine and of other machines, and calls of other machines
/// that load code or end something. Without `hosts`, other machines need a certificate (TLS). The log names the refused
/// peer. Call it once, after ORB_init() and before the ORB accepts calls. Throws std::runtime_error, one line, for a
/// user that this machine does not know or an entry of `hosts` that is not an address. [main-thread]
void control_access(const AccessRules& rules);

/// Throws CORBA::NO_PERMISSION if the request that this thread serves comes from another machine and is reserved for
/// processes of this user. For the servants of the operations that AccessRules names. [ORB thread]
void require_permission();

/// Returns the peer of a connection that this process has accepted, for messages: `user alice (1001) at
/// 127.0.0.1:4711`. Asks the kernel, and the user database. [ORB thread]
std::string describe_peer(omni::giopStrand& connection);

} // namespace RTC
