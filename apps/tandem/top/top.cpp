// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/state.hpp"
#include "apps/tandem/monitor/state_json.hpp"
#include "apps/tandem/monitor/state_reader.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "apps/tandem/top/commands.hpp"
#include "apps/tandem/top/named_links.hpp"
#include "shm/os/clock.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/ioctl.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace tandem::command {
namespace {

/// A host's use of the machine according to proc(5).
struct HostUsage {
    std::uint32_t pid = 0;
    std::string program;
    double cpu_percent = 0; ///< of one core, since the last read; 0 at the first
    std::uint64_t resident_bytes = 0;
    unsigned threads = 0;
    std::vector<std::string> links;
};

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

/// Reads the usage of hosts repeatedly. [one thread]
class HostUsageReader {
  public:
    /// Returns the usage of the running processes on these links, by pid. `now_ns`: CLOCK_MONOTONIC.
    std::vector<HostUsage> read(const monitor::State& state, std::uint64_t now_ns) {
        std::map<std::uint32_t, HostUsage> hosts;
        for (const auto& link : state.links)
            for (const auto& side : link.sides) {
                if (side.state != shm::PeerState::alive && side.state != shm::PeerState::stopped) continue;
                if (side.pid == 0) continue; // in another pid namespace, where /proc does not show it
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
                host.cpu_percent =
                    100.0 * static_cast<double>(now.cpu_ns - std::min(now.cpu_ns, before->second.cpu_ns)) /
                    static_cast<double>(now_ns - before->second.time_ns);
            samples[pid] = now;
            usages.push_back(std::move(host));
        }
        samples_ = std::move(samples);
        return usages;
    }

  private:
    struct Sample {
        std::uint64_t time_ns = 0, cpu_ns = 0;
    };
    std::map<std::uint32_t, Sample> samples_;
};

using monitor::LinkState;
using monitor::State;
using monitor::Times;

constexpr const char* clear_screen = "\033[H\033[2J";

std::string times_text(const Times& times) {
    if (times.samples == 0) return "-";
    const auto us = [](std::uint64_t ns) { return static_cast<double>(ns) / 1000; };
    return fmt::format("{:.1f} / {:.1f} / {:.1f}", us(times.p50_ns), us(times.p99_ns), us(times.max_ns));
}

std::string host_of(const LinkState& link, shm::Side side) {
    const auto& host = link.side(side);
    return host.program.empty() ? monitor::model_of(link, side) : host.program;
}

std::string hosts_table(const std::vector<HostUsage>& hosts) {
    Table table({"HOST", ">PID", ">CPU %", ">MEMORY", ">THREADS", "LINKS"});
    for (const auto& host : hosts) {
        std::string links;
        for (const auto& link : host.links) links += (links.empty() ? "" : ", ") + link;
        table.add_row({host.program, std::to_string(host.pid), fmt::format("{:.1f}", host.cpu_percent),
                       format_bytes(host.resident_bytes), std::to_string(host.threads), links});
    }
    return table.empty() ? "" : table.text() + "\n";
}

std::string ports_table(const State& state) {
    Table table(
        {"LINK", "PORT", "FROM", ">MSG/S", ">kB/S", ">AGE us p50 / p99 / max", ">LOST", ">WAITING", ">LAST"});
    for (const auto& link : state.links)
        for (const auto& port : link.ports) {
            if (!port.damage.empty()) {
                table.add_row({link.name, port.name, port.damage});
                continue;
            }
            table.add_row({link.name, port.name, host_of(link, port.writer),
                           fmt::format("{:.1f}", port.sent_per_s),
                           fmt::format("{:.1f}", port.bytes_per_s / 1000), times_text(port.recent_age),
                           std::to_string(port.counters.lost()), std::to_string(port.counters.waiting()),
                           port.silent_s ? fmt::format("{:.1f} s", *port.silent_s) : "-"});
        }
    return table.empty() ? "" : table.text() + "\n";
}

std::string ticks_table(const State& state) {
    Table table({"TICKS OF", ">PID", ">PERIOD ms", ">TICKS/S", ">CYCLE us p50 / p99 / max", ">LATEST us",
                 ">OVERRUNS", ">SKIPPED"});
    for (const auto& tick : state.ticks)
        table.add_row({tick.name, std::to_string(tick.pid),
                       fmt::format("{:g}", static_cast<double>(tick.period_ns) / 1e6),
                       tick.hang ? fmt::format("hangs {:.0f} s", tick.hang->seconds)
                                 : fmt::format("{:.1f}", tick.ticks_per_s),
                       times_text(tick.recent_execution),
                       fmt::format("{:.1f}", static_cast<double>(tick.latest_ns) / 1000),
                       std::to_string(tick.overruns), std::to_string(tick.skipped)});
    return table.empty() ? "" : table.text() + "\n";
}

std::string calls_table(const State& state) {
    Table table({"LINK", "CALLS FROM", ">CALLS/S", ">ROUND TRIP us p50 / p99 / max", ">OPEN", ">FAILED"});
    for (const auto& link : state.links)
        for (const auto& queue : link.call_queues)
            if (queue.damage.empty() && queue.counters.calls != 0)
                table.add_row({link.name, host_of(link, queue.callers),
                               fmt::format("{:.1f}", queue.calls_per_s), times_text(queue.recent_round_trip),
                               std::to_string(queue.open_calls),
                               std::to_string(queue.counters.timeouts + queue.counters.overloads)});
    return table.empty() ? "" : table.text();
}

/// Returns the part that fits into the terminal window, if there is one.
std::string fitted(const std::string& text) {
    winsize window{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_row == 0 || window.ws_col == 0)
        return text;
    std::istringstream lines(text);
    std::string fitting, line;
    for (unsigned row = 1; row < window.ws_row && std::getline(lines, line); ++row)
        fitting += line.substr(0, window.ws_col) + "\n";
    return fitting;
}

std::string json_of(const State& state, const std::vector<HostUsage>& hosts) {
    auto json = nlohmann::ordered_json::parse(monitor::state_json(state, monitor::judge(state), {}, nullptr));
    json.erase("events"); // only the monitor keeps events
    json.erase("control");
    json["hosts"] = nlohmann::ordered_json::array();
    for (const auto& host : hosts)
        json["hosts"].push_back({{"pid", host.pid},
                                 {"program", host.program},
                                 {"cpu_percent", host.cpu_percent},
                                 {"resident_bytes", host.resident_bytes},
                                 {"threads", host.threads},
                                 {"links", host.links}});
    return json.dump() + "\n";
}

} // namespace

int top(const TopOptions& options) {
    monitor::StateReader reader(options.links);
    HostUsageReader usage;
    const bool terminal = isatty(STDOUT_FILENO) != 0 && !options.json;
    State state = reader.read(); // rates and shares need two reads
    if (!state.error.empty()) throw std::runtime_error(state.error);
    require_links(state, options.links);
    usage.read(state, shm::now_ns());
    for (std::uint64_t picture = 0; options.count == 0 || picture < options.count; ++picture) {
        std::this_thread::sleep_for(std::chrono::duration<double>(options.period_s));
        state = reader.read(state);
        if (!state.error.empty()) throw std::runtime_error(state.error);
        const auto hosts = usage.read(state, shm::now_ns());
        if (options.json) {
            print_text(json_of(state, hosts));
            continue;
        }
        const auto verdict = monitor::judge(state);
        const std::string text = verdict.text + (verdict.reason.empty() ? "" : ": " + verdict.reason) + "\n" +
                                 (state.cut.empty() ? "" : state.cut + "\n") + "\n" + hosts_table(hosts) +
                                 ports_table(state) + ticks_table(state) + calls_table(state);
        if (terminal) print_data(clear_screen);
        print_text(terminal ? fitted(text) : text + "\n");
    }
    return 0;
}

} // namespace tandem::command
