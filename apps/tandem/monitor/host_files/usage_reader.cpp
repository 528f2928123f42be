// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/host_files/usage_reader.hpp"

#include "apps/tandem/output/format.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

namespace tandem::monitor {
namespace {

constexpr std::uint64_t usage_pause_ns =
    900'000'000; // clock ticks of 10 ms would make a shorter share coarse

struct Stat {
    std::string name;
    char state = '?';
    std::uint64_t cpu_ns = 0, resident_bytes = 0;
    unsigned threads = 0;
};

/// Reads /proc/PID/stat or /proc/PID/task/TID/stat. State is field 3, user and system time in clock ticks are fields 14 and
/// 15, threads 20, resident pages 24. Field 2, the name, is in parentheses and may contain parentheses.
std::optional<Stat> read_stat(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    const auto name_begin = line.find('('), name_end = line.rfind(')');
    if (name_end == std::string::npos || name_begin > name_end) return {};
    std::istringstream fields(line.substr(name_end + 2));
    std::string skipped;
    Stat stat;
    stat.name = command::replace_nonprintable(line.substr(name_begin + 1, name_end - name_begin - 1));
    fields >> stat.state;
    for (int field = 4; field < 14; ++field) fields >> skipped;
    std::uint64_t user = 0, system = 0, resident = 0;
    fields >> user >> system;
    for (int field = 16; field < 20; ++field) fields >> skipped;
    fields >> stat.threads;
    for (int field = 21; field < 24; ++field) fields >> skipped;
    fields >> resident;
    if (!fields) return {};
    stat.cpu_ns = (user + system) * 1'000'000'000 / static_cast<std::uint64_t>(sysconf(_SC_CLK_TCK));
    stat.resident_bytes = resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    return stat;
}

} // namespace

/// Notes the sample. Returns the share of a processor since the last look, in percent.
double UsageReader::share(const Key& key, const Sample& now) {
    next_[key] = now;
    const auto before = samples_.find(key);
    if (before == samples_.end() || now.time_ns <= before->second.time_ns) return 0;
    return 100.0 * static_cast<double>(now.cpu_ns - std::min(now.cpu_ns, before->second.cpu_ns)) /
           static_cast<double>(now.time_ns - before->second.time_ns);
}

std::vector<ThreadUsage> UsageReader::read_threads(std::uint32_t pid, std::uint64_t now_ns) {
    std::vector<ThreadUsage> threads;
    std::error_code failure;
    for (const auto& entry :
         std::filesystem::directory_iterator(fmt::format("/proc/{}/task", pid), failure)) {
        const auto stat = read_stat(entry.path() / "stat");
        const auto tid = static_cast<std::uint32_t>(std::atoll(entry.path().filename().c_str()));
        if (stat) threads.push_back({tid, stat->name, share({pid, tid}, {now_ns, stat->cpu_ns})});
    }
    std::stable_sort(threads.begin(), threads.end(),
                     [](const auto& a, const auto& b) { return a.cpu_percent > b.cpu_percent; });
    if (threads.size() > most_threads) threads.resize(most_threads);
    return threads;
}

/// Returns nothing if the process has ended.
std::optional<HostUsage> UsageReader::read_host(std::uint32_t pid, std::uint64_t now_ns) {
    const auto stat = read_stat(fmt::format("/proc/{}/stat", pid));
    if (!stat || stat->state == 'Z' || stat->state == 'X') return {};
    return HostUsage{stat->state == 'T' || stat->state == 't', share({pid, 0}, {now_ns, stat->cpu_ns}),
                     stat->resident_bytes, stat->threads, read_threads(pid, now_ns)};
}

void UsageReader::read(std::vector<HostState>& hosts, std::uint64_t now_ns) {
    const bool looks = now_ns >= next_look_ns_ || looks_ < 2; // shares need two readings
    if (looks) {
        next_look_ns_ = now_ns + usage_pause_ns;
        ++looks_;
        looked_.clear();
        next_.clear();
    }
    std::erase_if(hosts, [&](HostState& host) {
        auto looked = looked_.find(host.pid);
        if (looked == looked_.end()) {
            auto usage = read_host(host.pid, now_ns);
            if (!usage) return true;
            looked = looked_.emplace(host.pid, std::move(*usage)).first;
        }
        host.usage = looked->second;
        return false;
    });
    if (looks) samples_.swap(next_);
}

} // namespace tandem::monitor
