// SPDX-License-Identifier: Apache-2.0
// The places where managers of one user reach each other on a machine: one Unix socket each, in a folder that only this
// user can enter.
// Programs in apps/ include this header.
#pragma once
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace RTC {

/// The Unix socket of a manager of this user.
struct LocalEndpoint {
    pid_t pid; ///< in the process namespace of the manager
    std::filesystem::path socket;
};

/// Returns a path for the socket of this process that no other process has. The path is in a folder of mode 0700 that
/// belongs to this user: `tandem` in XDG_RUNTIME_DIR, or else one in /dev/shm, where the segments are. Removes the
/// sockets that ended processes have left there. Throws std::runtime_error, one line, if no such folder can be made.
/// [main-thread]
std::filesystem::path make_local_endpoint();

/// Returns the sockets in all such folders of this user, including those of processes that have ended. [any-thread]
std::vector<LocalEndpoint> find_local_endpoints();

/// Removes the socket of this process, for a process whose manager nobody needs to reach. [main-thread]
void remove_local_endpoint();

/// Returns whether a process accepts connections at the socket. [any-thread; does not block]
bool accepts_connections(const std::filesystem::path& socket);

} // namespace RTC
