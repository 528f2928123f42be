// SPDX-License-Identifier: Apache-2.0
#include "host/process/start_failure.hpp"

#include <cerrno>
#include <sys/resource.h>
#include <system_error>

namespace tandem::process {
namespace {

std::string process_limit() {
    rlimit limit{};
    if (getrlimit(RLIMIT_NPROC, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return "none";
    return std::to_string(limit.rlim_cur);
}

} // namespace

std::string start_remedy(int error) {
    switch (error) {
    case EAGAIN:
        return "; the limit of processes and threads of this user (ulimit -u) is " + process_limit() +
               ": raise it, TasksMax= of the service, or pids.max of the container, or end other processes";
    case ENOMEM:
        return "; free some memory, or raise the limit of address space (ulimit -v)";
    case EPERM:
    case ENOSYS:
        return "; a container runtime older than this system's C library refuses clone3() or pidfd_open(): "
               "update it, or its seccomp profile";
    default:
        return "";
    }
}

std::string explain(const std::exception& error) {
    const auto* const system = dynamic_cast<const std::system_error*>(&error);
    if (system == nullptr || system->code().message() != error.what()) return error.what();
    return std::string("a thread cannot be started: ") + error.what() + start_remedy(system->code().value());
}

} // namespace tandem::process
