// SPDX-License-Identifier: Apache-2.0
// Who may do what with the objects of this process by CORBA.
#pragma once
#include <coil/Properties.h>
#include <string>
#include <vector>

namespace RTC {

/// What rtc.conf permits beyond what this user's own processes, and root's, may always do.
struct AccessRules {
    std::vector<std::string> users; ///< of this machine, by name or number: like this user
    bool remote_load = false;       ///< other machines may load code
    bool remote_shutdown = false;   ///< other machines may end this process and its components
};

/// Reads corba.permitted_users, manager.modules.remote_load and manager.remote_shutdown.
AccessRules read_access_rules(const coil::Properties& config);

/// Refuses connections of other users of this machine, and calls of other machines that load code or end something, from now
/// on. The log names who was refused. Once, after ORB_init() and before the ORB takes calls. Throws std::runtime_error, one
/// line, for a user whom this machine does not know. [main-thread]
void control_access(const AccessRules& rules);

/// Throws CORBA::NO_PERMISSION if the request that this thread serves is one that only this user's processes may make, and
/// comes from another machine. For the servants of the operations that AccessRules names. [ORB thread]
void require_permission();

} // namespace RTC
