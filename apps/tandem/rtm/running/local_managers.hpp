// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <omniORB4/CORBA.h>

#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::command {

/// HOST:PORT of the RTM managers in this user's processes on this machine: TCP ports on which a process with an ORB
/// listens and a manager answers. Needs no name server and no well-known port. Other users' processes cannot be read in
/// /proc and are left out.
/// A candidate that does not answer in half a second is not a manager.
/// `pid`: of that process only, if it is not 0.
std::vector<std::string> find_local_managers(CORBA::ORB_ptr orb, pid_t pid = 0);

} // namespace tandem::command
