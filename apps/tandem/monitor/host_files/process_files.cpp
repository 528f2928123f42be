// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/host_files/process_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

namespace tandem::monitor {

std::vector<RunningHost> running_hosts(const State& state) {
    std::vector<RunningHost> hosts;
    std::set<std::uint32_t> seen;
    for (const LinkState& link : state.links)
        for (const SideState& side : link.sides)
            if (side.state == shm::PeerState::alive && side.pid != 0 && seen.insert(side.pid).second)
                hosts.push_back({side.pid, side.program});
    for (const HostState& host : state.hosts)
        if (!host.usage.stopped && seen.insert(host.pid).second) hosts.push_back({host.pid, host.program});
    return hosts;
}

std::string program_of(std::uint32_t pid) {
    std::ifstream file(fmt::format("/proc/{}/comm", pid));
    std::string name;
    std::getline(file, name);
    return command::replace_nonprintable(name);
}

std::vector<process::FileDescriptor> open_memory_files(std::uint32_t pid, const char* name,
                                                       std::size_t size) {
    constexpr std::size_t most = 8;
    std::vector<process::FileDescriptor> files;
    std::set<ino_t> known; // a process may have several descriptors of a file
    const std::string wanted = fmt::format("/memfd:{} (deleted)", name);
    std::error_code failure;
    for (const auto& entry : std::filesystem::directory_iterator(fmt::format("/proc/{}/fd", pid), failure)) {
        std::error_code gone;
        if (files.size() >= most || std::filesystem::read_symlink(entry.path(), gone) != wanted) continue;
        // The owner has opened it for writing; another monitor reads it only.
        constexpr auto writable = std::filesystem::perms::owner_write;
        if ((entry.symlink_status(gone).permissions() & writable) == std::filesystem::perms::none) continue;
        process::FileDescriptor file(open(entry.path().c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
        struct stat info {};
        if (file.get() >= 0 && fstat(file.get(), &info) == 0 && info.st_size == static_cast<off_t>(size) &&
            known.insert(info.st_ino).second)
            files.push_back(std::move(file));
    }
    return files;
}

} // namespace tandem::monitor
