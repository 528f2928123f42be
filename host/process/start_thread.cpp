// SPDX-License-Identifier: Apache-2.0
#include "host/process/start_thread.hpp"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>
#include <vector>

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

/// Returns the value of a line such as `Threads:\t5` of /proc/PID/status; 0 if there is none.
unsigned long read_field(const fs::path& status, const std::string& name) {
    std::ifstream in(status);
    for (std::string word; in >> word; in.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
        if (unsigned long value = 0; word == name) return in >> value ? value : 0;
    return 0;
}

/// Returns how many threads the user of this process has, as far as /proc shows them.
unsigned long threads_of_this_user() {
    unsigned long count = 0;
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator("/proc", unreadable))
        if (entry.path().filename().string().find_first_not_of("0123456789") == std::string::npos &&
            read_field(entry.path() / "status", "Uid:") == getuid())
            count += read_field(entry.path() / "status", "Threads:");
    return count;
}

/// Returns whether the stack of another thread does not fit any more.
bool is_address_space_full(unsigned long limit) {
    const auto used = read_field("/proc/self/status", "VmSize:") << 10;
    return used + soft_limit(RLIMIT_STACK).value_or(8UL << 20) > limit;
}

/// Returns whether the machine has as many threads as it may. The fourth word of /proc/loadavg is `running/all`.
bool is_machine_full() {
    std::ifstream in("/proc/loadavg");
    std::string word;
    for (int i = 0; i < 4; ++i) in >> word;
    const auto max = read_number("/proc/sys/kernel/threads-max");
    const auto all = word.find('/');
    return max && all != word.npos && std::strtoul(word.c_str() + all + 1, nullptr, 10) >= *max;
}

struct Limit {
    std::string text;
    bool reached;
};

std::vector<Limit> possible_limits() {
    std::vector<Limit> limits;
    if (const auto bytes = soft_limit(RLIMIT_AS))
        limits.push_back({"the process may use " + std::to_string(*bytes >> 20) +
                              " MiB of addresses, which stacks of threads need (ulimit -v)",
                          is_address_space_full(*bytes)});
    // The kernel does not count the threads of root.
    if (const auto threads = soft_limit(RLIMIT_NPROC); threads && getuid() != 0)
        limits.push_back({"user " + std::to_string(getuid()) + " may have " + std::to_string(*threads) +
                              " processes and threads (ulimit -u)",
                          threads_of_this_user() >= *threads});
    limits.push_back({"the machine has no room for more processes and threads (memory, kernel.threads-max, "
                      "kernel.pid_max)",
                      is_machine_full()});
    return limits;
}

/// Returns the limit that is reached. The kernel does not tell which one it is, and /proc may hide what counts: then
/// returns all limits that are set.
std::string limit_text() {
    if (std::string full = full_control_group(); !full.empty()) return full;
    const std::string remedy = "; end some, or raise it";
    std::string all;
    const auto limits = possible_limits();
    for (const Limit& limit : limits) {
        if (limit.reached) return limit.text + remedy;
        all += (all.empty() ? "" : "; or ") + limit.text;
    }
    return (limits.size() > 1 ? "one of these limits is reached: " : "") + all + remedy;
}

std::string explain(int error) {
    std::string reason = std::generic_category().message(error);
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
