// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/host_files/host_reader.hpp"

#include "apps/tandem/monitor/host_files/process_files.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>

namespace tandem::monitor {
namespace {

/// A search reads /proc/PID/fd of every process of the user.
constexpr std::uint64_t host_look_pause_ns = 1'000'000'000;

/// Returns the hosts of the links that run. A stopped process counts.
std::vector<HostState> hosts_of_links(const State& state) {
    std::vector<HostState> hosts;
    for (const LinkState& link : state.links)
        for (const SideState& side : link.sides) {
            const bool runs = side.state == shm::PeerState::alive || side.state == shm::PeerState::stopped;
            if (!runs || side.pid == 0) continue; // 0: in another pid namespace, where /proc does not show it
            auto host = std::find_if(hosts.begin(), hosts.end(),
                                     [&](const HostState& each) { return each.pid == side.pid; });
            if (host == hosts.end()) host = hosts.insert(host, {side.pid, side.program});
            if (host->links.empty() || host->links.back() != link.name) host->links.push_back(link.name);
        }
    return hosts;
}

/// Returns the processes of this user.
std::vector<std::uint32_t> own_processes() {
    std::vector<std::uint32_t> pids;
    std::error_code failure;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", failure)) {
        const std::string name = entry.path().filename();
        std::uint32_t pid = 0;
        const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), pid);
        struct stat info {};
        if (error == std::errc() && end == name.data() + name.size() &&
            stat(entry.path().c_str(), &info) == 0 && info.st_uid == getuid())
            pids.push_back(pid);
    }
    return pids;
}

} // namespace

void HostReader::look(const State& state) {
    std::vector<std::uint32_t> pids;
    if (without_links_)
        pids = own_processes();
    else
        for (const HostState& host : state.hosts) pids.push_back(host.pid);
    inventories_.keep(pids);
    found_.clear();
    for (const std::uint32_t pid : pids)
        if (inventories_.look(pid)) found_[pid] = program_of(pid);
}

void HostReader::read(State& state, std::uint64_t now_ns) {
    state.hosts = hosts_of_links(state);
    std::set<std::uint32_t> linked;
    for (const HostState& host : state.hosts) linked.insert(host.pid);
    if (now_ns >= next_look_ns_ || linked != linked_) {
        next_look_ns_ = now_ns + host_look_pause_ns;
        linked_ = linked;
        look(state);
    }
    std::size_t left_out = 0;
    if (without_links_)
        for (const auto& [pid, program] : found_) {
            if (linked.count(pid) != 0) continue;
            if (state.hosts.size() < max_hosts)
                state.hosts.push_back({pid, program});
            else
                ++left_out;
        }
    if (left_out != 0)
        state.unseen.push_back(std::to_string(left_out) + " more hosts without a link are not shown");
    usage_.read(state.hosts, now_ns);
    for (HostState& host : state.hosts) {
        host.inventory = inventories_.read(host.pid);
        if (host.inventory != nullptr && host.inventory->left_out != 0)
            state.unseen.push_back(host.program + " (pid " + std::to_string(host.pid) +
                                   "): " + std::to_string(host.inventory->left_out) +
                                   " of its components, ports and connections are not shown");
    }
}

} // namespace tandem::monitor
