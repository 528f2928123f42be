// SPDX-License-Identifier: Apache-2.0
#include "host/process/start_thread.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sys/resource.h>
#include <unistd.h>

namespace tandem::process {
namespace {

namespace fs = std::filesystem;

std::optional<unsigned long> read_number(const fs::path& file) {
    std::ifstream in(file);
    unsigned long number = 0;
    return in >> number ? std::optional(number) : std::nullopt; // pids.max may be `max`
}

/// Returns the folder of this process's control group: `0::/a/b` (version 2) or `4:pids:/a/b` (version 1).
std::optional<fs::path> control_group() {
    std::ifstream in("/proc/self/cgroup");
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("0::/")) return fs::path("/sys/fs/cgroup" + line.substr(3));
        if (const auto at = line.find(":pids:/"); at != std::string::npos)
            return fs::path("/sys/fs/cgroup/pids" + line.substr(at + 6));
    }
    return std::nullopt;
}

/// Returns the limit of the control group that is full, or of one that contains it; empty if none is full.
std::string full_control_group() {
    const auto group = control_group();
    if (!group) return "";
    for (fs::path folder = *group; folder.string().starts_with("/sys/fs/cgroup");
         folder = folder.parent_path()) {
        const auto max = read_number(folder / "pids.max"), current = read_number(folder / "pids.current");
        if (max && current && *current >= *max)
            return "the control group " + folder.string() + " has its limit of " + std::to_string(*max) +
                   " processes and threads (pids.max); raise TasksMax of the service, or --pids-limit of the "
                   "container";
    }
    return "";
}

std::optional<unsigned long> soft_limit(__rlimit_resource resource) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
    return limit.rlim_cur;
}

// The kernel does not tell which limit it is: the full control group, or else the limits that are set.
std::string limit_text() {
    if (const std::string full = full_control_group(); !full.empty()) return full;
    if (const auto bytes = soft_limit(RLIMIT_AS))
        return "the process may use " + std::to_string(*bytes >> 20) +
               " MiB of addresses (ulimit -v), and a thread needs them for its stack; raise it";
    if (const auto threads = soft_limit(RLIMIT_NPROC))
        return "user " + std::to_string(getuid()) + " may have " + std::to_string(*threads) +
               " processes and threads (ulimit -u); end some, or raise it";
    return "the machine has no room for more processes and threads; end some, or raise kernel.threads-max";
}

std::string explain(int error) {
    const std::string reason = std::generic_category().message(error);
    if (error == EAGAIN || error == ENOMEM) return reason + ": " + limit_text();
    if (error == EPERM || error == ENOSYS)
        return reason +
               ": the container or the kernel refuses a system call that Tandem needs; update the container "
               "runtime, or start the container with --security-opt seccomp=unconfined";
    return reason;
}

} // namespace

NotStarted::NotStarted(int error, const std::string& what)
    : std::system_error(error, std::generic_category()), text_(what + ": " + explain(error)) {}

std::thread start_thread(std::function<void()> work) {
    try {
        return std::thread(std::move(work));
    } catch (const std::system_error& error) {
        throw NotStarted(error.code().value(), "no thread can be started");
    }
}

bool start_detached(std::function<void()> work) {
    try {
        std::thread(std::move(work)).detach();
        return true;
    } catch (const std::system_error&) {
        return false;
    }
}

} // namespace tandem::process
