// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <omniORB4/CORBA.h>

#include <string>
#include <vector>

namespace tandem::command {

/// Addresses `127.0.0.1:PORT` of the RTM managers in this user's processes on this machine: TCP ports on
/// which processes with an ORB listen, and where a manager answers.
std::vector<std::string> find_local_managers(CORBA::ORB_ptr orb);

} // namespace tandem::command
