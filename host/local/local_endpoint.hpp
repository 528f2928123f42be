// SPDX-License-Identifier: Apache-2.0
// The places where hosts of one user are reached on a machine: one Unix socket each, in a folder that only this user can
// enter.
#pragma once
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::local {

/// The kinds of sockets: of a manager of RTCs (CORBA), and of an opros_host (host/opros/control).
inline constexpr const char* manager_endpoint = "manager";
inline constexpr const char* opros_endpoint = "opros";

/// The Unix socket of a host of this user.
struct LocalEndpoint {
    pid_t pid; ///< in the process namespace of the host
    std::filesystem::path socket;
};

/// Returns a path for a socket of this process that no other process has. The path is in a folder of mode 0700 that
/// belongs to this user: `tandem` in XDG_RUNTIME_DIR, or else one in /dev/shm, where the segments are. Removes the
/// sockets of this kind that ended processes have left there. Throws std::runtime_error, one line, if no such folder can
/// be made. [main-thread]
std::filesystem::path make_local_endpoint(const std::string& kind);

/// Returns the sockets in all such folders of this user, including those of processes that have ended. [any-thread]
std::vector<LocalEndpoint> find_local_endpoints(const std::string& kind);

/// Removes the sockets of processes that have ended. [any-thread]
void remove_ended_endpoints(const std::string& kind);

/// Removes the socket of this process, for a process that nobody needs to reach. [main-thread]
void remove_local_endpoint(const std::string& kind);

/// Returns whether a process accepts connections at the socket. [any-thread; does not block]
bool accepts_connections(const std::filesystem::path& socket);

} // namespace tandem::local
