// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <omniORB4/CORBA.h>

#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::command {

/// Returns the addresses of the RTM managers in this user's processes on this machine: `unix:PID`, or HOST:PORT of a
/// process that has only TCP ports, as OpenRTM-aist's. Needs no name server and no well-known port. A candidate that does not
/// answer in half a second is left out. `pid`: of that process only, if it is not 0.
std::vector<std::string> find_local_managers(CORBA::ORB_ptr orb, pid_t pid = 0);

} // namespace tandem::command
