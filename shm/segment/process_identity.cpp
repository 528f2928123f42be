// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/process_identity.hpp"

#include "shm/os/file_descriptor.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <optional>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

namespace tandem::shm {
namespace {

std::uint64_t inode_of(const char* file) {
    struct stat status {};
    return stat(file, &status) == 0 ? status.st_ino : 0;
}

/// Fields of /proc/PID/task/PID/stat.
struct ProcessStatus {
    char state = 0;
    std::uint64_t threads = 0, start_ticks = 0;
};

/// Reads the file of the main thread, because qemu-user makes up the start time in the file of the process itself.
std::optional<ProcessStatus> read_status(std::uint32_t pid) {
    std::array<char, 48> path; // without an allocation
    std::snprintf(path.data(), path.size(), "/proc/%u/task/%u/stat", pid, pid);
    const FileDescriptor file(::open(path.data(), O_RDONLY | O_CLOEXEC));
    std::array<char, 1024> buffer; // the longest line has 52 numbers
    const ssize_t size = file ? read(file.get(), buffer.data(), buffer.size()) : 0;
    std::string_view rest(buffer.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
    const auto name_end = rest.rfind(") "); // the name, field 2, may contain any characters
    if (name_end == rest.npos) return std::nullopt;
    ProcessStatus status;
    rest.remove_prefix(name_end + 2);
    for (int field = 3; field <= 22; ++field) {
        const std::string_view word = rest.substr(0, rest.find(' '));
        if (word.empty()) return std::nullopt;
        if (field == 3) status.state = word[0];
        if (field == 20) std::from_chars(word.begin(), word.end(), status.threads);
        if (field == 22) std::from_chars(word.begin(), word.end(), status.start_ticks);
        rest.remove_prefix(std::min(rest.size(), word.size() + 1));
    }
    return status;
}

/// The main thread of a process may end before its other threads; /proc then shows the process as a zombie, too.
bool is_zombie(const ProcessStatus& status) {
    return (status.state == 'Z' || status.state == 'X') && status.threads <= 1;
}

/// Returns whether /proc shows the pid namespace of this process. In a new pid namespace, /proc shows the old one until it
/// is mounted again.
bool proc_shows_this_namespace() {
    std::array<char, 16> self;
    const ssize_t size = readlink("/proc/self", self.data(), self.size());
    return size > 0 &&
           std::string_view(self.data(), static_cast<std::size_t>(size)) == std::to_string(getpid());
}

} // namespace

ProcessIdentity identify_this_process() {
    const auto pid = static_cast<std::uint32_t>(getpid());
    // Without a /proc of this namespace, another process may have this id there.
    const auto status = proc_shows_this_namespace() ? read_status(pid) : std::nullopt;
    return {pid, inode_of("/proc/self/ns/pid"), inode_of("/proc/self/ns/time"),
            status ? status->start_ticks : 0};
}

ProcessLookup find_process(const ProcessIdentity& identity) {
    if (identity.pid == 0 || identity.pid > INT_MAX || identity.pid_namespace == 0 ||
        identity.pid_namespace != inode_of("/proc/self/ns/pid"))
        return ProcessLookup::elsewhere;
    if (::kill(static_cast<pid_t>(identity.pid), 0) != 0 && errno == ESRCH) return ProcessLookup::ended;
    if (!proc_shows_this_namespace()) return ProcessLookup::elsewhere;
    const auto status = read_status(identity.pid);
    if (!status) return ProcessLookup::elsewhere; // /proc may hide it
    if (is_zombie(*status)) return ProcessLookup::ended;
    const bool comparable = identity.start_ticks != 0 && status->start_ticks != 0 &&
                            identity.time_namespace == inode_of("/proc/self/ns/time");
    return comparable && identity.start_ticks != status->start_ticks ? ProcessLookup::ended
                                                                     : ProcessLookup::running;
}

} // namespace tandem::shm
