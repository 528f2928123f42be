// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/state.hpp"
#include "apps/tandem/monitor/state_json.hpp"
#include "apps/tandem/monitor/state_reader.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "apps/tandem/top/commands.hpp"
#include "apps/tandem/top/named_links.hpp"
#include "host/text/join.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fmt/format.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/ioctl.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace tandem::command {
namespace {

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

std::string hosts_table(const std::vector<monitor::HostState>& hosts) {
    Table table({"HOST", ">PID", ">CPU %", ">MEMORY", ">THREADS", "LINKS"});
    for (const auto& host : hosts) {
        table.add_row({host.program, std::to_string(host.pid), fmt::format("{:.1f}", host.usage.cpu_percent),
                       format_bytes(host.usage.resident_bytes), std::to_string(host.usage.thread_count),
                       text::join(host.links, ", ")});
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

std::string json_of(const State& state) {
    auto json = nlohmann::ordered_json::parse(monitor::state_json(state, monitor::judge(state), {}, nullptr));
    json.erase("events"); // only the monitor keeps events
    json.erase("control");
    return json.dump() + "\n";
}

} // namespace

int top(const TopOptions& options) {
    monitor::StateReader reader(options.links);
    const bool terminal = isatty(STDOUT_FILENO) != 0 && !options.json;
    State state = reader.read(); // rates and shares need two reads
    if (!state.error.empty()) throw std::runtime_error(state.error);
    require_links(state, options.links);
    for (std::uint64_t picture = 0; options.count == 0 || picture < options.count; ++picture) {
        std::this_thread::sleep_for(std::chrono::duration<double>(options.period_s));
        state = reader.read(state);
        if (!state.error.empty()) throw std::runtime_error(state.error);
        if (options.json) {
            print_text(json_of(state));
            continue;
        }
        const auto verdict = monitor::judge(state);
        const std::string text = verdict.text + (verdict.reason.empty() ? "" : ": " + verdict.reason) + "\n" +
                                 (state.cut.empty() ? "" : state.cut + "\n") + "\n" +
                                 hosts_table(state.hosts) + ports_table(state) + ticks_table(state) +
                                 calls_table(state);
        if (terminal) print_data(clear_screen);
        print_text(terminal ? fitted(text) : text + "\n");
    }
    return 0;
}

} // namespace tandem::command
