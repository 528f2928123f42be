// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/host_files/status_reader.hpp"

#include "apps/tandem/monitor/host_files/process_files.hpp"

#include <dirent.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <set>
#include <utility>

namespace tandem::monitor {
namespace {

using process::ComponentState;
using process::ComponentStates;
using process::NoticeKind;
using process::Notices;

/// Returns why the open files of a process cannot be listed; empty if they can, or if the process is gone.
std::string listing_error(std::uint32_t pid) {
    if (DIR* const folder = opendir(fmt::format("/proc/{}/fd", pid).c_str())) {
        closedir(folder);
        return "";
    }
    return errno == EACCES || errno == EPERM ? std::strerror(errno) : "";
}

/// The state that counts if a component has several, one for each execution context.
ComponentState combined(ComponentState a, ComponentState b) { return std::max(a, b); }
static_assert(ComponentState::error > ComponentState::active &&
              ComponentState::active > ComponentState::inactive);

void add_components(const ComponentStates& file, std::uint64_t now_ns,
                    std::map<std::string, ComponentStatus>& all) {
    for (const auto& place : file.place) {
        const auto state = static_cast<ComponentState>(place.state);
        if (state == ComponentState::none || state > ComponentState::error) continue;
        ComponentStatus& known = all[printable_text(place.name)];
        known.state = combined(known.state, state);
        const auto since_ns = static_cast<double>(place.in_cycle_since_ns);
        if (since_ns > 0)
            known.in_cycle_s = std::max(known.in_cycle_s, (static_cast<double>(now_ns) - since_ns) / 1e9);
    }
}

/// Returns why a component is in ERROR, and removes its notices: `NAME: REASON` or `component NAME: REASON`.
std::string take_reason(const std::string& name, std::vector<NoticeState>& notices) {
    std::string reason;
    std::erase_if(notices, [&](const NoticeState& notice) {
        for (const std::string& head : {name + ": ", "component " + name + ": "})
            if (notice.kind == NoticeKind::component && notice.text.starts_with(head)) {
                if (reason.empty()) reason = notice.text.substr(head.size());
                return true;
            }
        return false;
    });
    return reason;
}

} // namespace

void StatusReader::look(Process& process, std::uint32_t pid, std::uint64_t now_ns) {
    if (now_ns < process.next_look_ns) return;
    process.next_look_ns = now_ns + file_search_pause_ns;
    process.unseen = listing_error(pid);
    process.components = open_memory_files(pid, ComponentStates::file_name, sizeof(ComponentStates));
    process.notices = open_memory_files(pid, Notices::file_name, sizeof(Notices));
}

void StatusReader::read_process(std::uint32_t pid, const std::string& program, State& state,
                                std::uint64_t now_ns) {
    Process& process = processes_[pid];
    look(process, pid, now_ns);
    std::map<std::string, ComponentStatus> states;
    for (const auto& descriptor : process.components)
        if (const auto file = read_memory_file<ComponentStates>(descriptor)) {
            add_components(*file, now_ns, states);
            if (file->left_out != 0)
                state.unseen.push_back(
                    fmt::format("{} (pid {}): the states of {} further components are not shown", program,
                                pid, file->left_out));
        }
    std::vector<NoticeState> notices;
    for (const auto& descriptor : process.notices)
        if (const auto file = read_memory_file<Notices>(descriptor))
            for (const auto& place : file->place)
                if (place.kind != 0)
                    notices.push_back(
                        {program, pid, static_cast<NoticeKind>(place.kind), printable_text(place.text)});
    for (auto& [name, component] : states)
        state.components.push_back(
            {program, pid, name, component.state, component.in_cycle_s,
             component.state == ComponentState::error ? take_reason(name, notices) : ""});
    std::move(notices.begin(), notices.end(), std::back_inserter(state.notices));
}

/// Notes the hosts of links whose files this process cannot see.
void StatusReader::note_unseen(const State& state, std::vector<std::string>& unseen) const {
    std::set<std::uint32_t> noted;
    for (const LinkState& link : state.links)
        for (const SideState& side : link.sides) {
            if (side.state != shm::PeerState::alive) continue;
            if (side.pid_elsewhere != 0)
                unseen.push_back(fmt::format(
                    "link {}: ticks and components of the host with {} cannot be seen; run this in its "
                    "container, too",
                    link.name, command::format_pid(side.pid, side.pid_elsewhere)));
            const auto process = processes_.find(side.pid);
            if (process != processes_.end() && !process->second.unseen.empty() &&
                noted.insert(side.pid).second)
                unseen.push_back(
                    fmt::format("link {}: ticks and components of {} (pid {}) cannot be seen: {}; run "
                                "this as the user of the host, which must not have file capabilities",
                                link.name, side.program, side.pid, process->second.unseen));
        }
}

void StatusReader::read(State& state, std::uint64_t now_ns) {
    read_running_hosts(state, processes_, [&](std::uint32_t pid, const std::string& program) {
        read_process(pid, program, state, now_ns);
    });
    note_unseen(state, state.unseen);
}

} // namespace tandem::monitor
