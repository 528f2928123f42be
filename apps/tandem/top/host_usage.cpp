// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/top/host_usage.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace tandem::command {
namespace {

/// proc(5), /proc/PID/stat: user and system time in clock ticks are fields 14 and 15, threads 20, resident pages 24.
/// Field 2, the name, is in parentheses and may contain parentheses.
bool read_stat(std::uint32_t pid, std::uint64_t& cpu_ns, HostUsage& usage) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    std::string line;
    std::getline(file, line);
    const auto name_end = line.rfind(')');
    if (name_end == std::string::npos) return false;
    std::istringstream fields(line.substr(name_end + 2));
    std::string skipped;
    for (int field = 3; field < 14; ++field) fields >> skipped;
    std::uint64_t user = 0, system = 0, resident = 0;
    fields >> user >> system;
    for (int field = 16; field < 20; ++field) fields >> skipped;
    fields >> usage.threads;
    for (int field = 21; field < 24; ++field) fields >> skipped;
    fields >> resident;
    if (!fields) return false;
    const auto ticks_per_s = static_cast<std::uint64_t>(sysconf(_SC_CLK_TCK));
    cpu_ns = (user + system) * 1'000'000'000 / ticks_per_s;
    usage.resident_bytes = resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    return true;
}

} // namespace

std::vector<HostUsage> HostUsageReader::read(const monitor::State& state, std::uint64_t now_ns) {
    std::map<std::uint32_t, HostUsage> hosts;
    for (const auto& link : state.links)
        for (const auto& side : link.sides) {
            if (side.state != shm::PeerState::alive && side.state != shm::PeerState::stopped) continue;
            HostUsage& host = hosts[side.pid];
            host.pid = side.pid;
            host.program = side.program;
            if (host.links.empty() || host.links.back() != link.name) host.links.push_back(link.name);
        }
    std::vector<HostUsage> usages;
    std::map<std::uint32_t, Sample> samples;
    for (auto& [pid, host] : hosts) {
        Sample now{now_ns, 0};
        if (!read_stat(pid, now.cpu_ns, host)) continue; // the process is gone
        if (const auto before = samples_.find(pid);
            before != samples_.end() && now_ns > before->second.time_ns)
            host.cpu_percent = 100.0 *
                               static_cast<double>(now.cpu_ns - std::min(now.cpu_ns, before->second.cpu_ns)) /
                               static_cast<double>(now_ns - before->second.time_ns);
        samples[pid] = now;
        usages.push_back(std::move(host));
    }
    samples_ = std::move(samples);
    return usages;
}

} // namespace tandem::command
