// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <omniORB4/CORBA.h>

#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::command {

/// Returns the addresses of the RTM managers in this user's processes on this machine: `unix:PID`, or HOST:PORT for a
/// process with only TCP ports, as in OpenRTM-aist. Needs no name server and no well-known port. Omits candidates that
/// do not answer within half a second. `pid`: only of this process, unless 0.
std::vector<std::string> find_local_managers(CORBA::ORB_ptr orb, pid_t pid = 0);

} // namespace tandem::command
