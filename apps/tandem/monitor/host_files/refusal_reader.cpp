// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/host_files/refusal_reader.hpp"

#include "apps/tandem/monitor/host_files/process_files.hpp"
#include "host/process/published/refused_connections.hpp"

#include <unistd.h>

#include <cstring>
#include <set>

namespace tandem::monitor {

using process::RefusedConnections;

namespace {

constexpr std::size_t max_files = 8; ///< of a process: one for each library that makes connections

} // namespace

void RefusalReader::read_process(std::uint32_t pid, const std::string& program, State& state,
                                 std::uint64_t now_ns) {
    Process& process = processes_[pid];
    if (now_ns >= process.next_look_ns) {
        process.next_look_ns = now_ns + look_pause_ns;
        process.files =
            open_memory_files(pid, RefusedConnections::file_name, sizeof(RefusedConnections), max_files);
    }
    for (const auto& file : process.files) {
        RefusedConnections copy{};
        if (pread(file.get(), &copy, sizeof copy, 0) != static_cast<ssize_t>(sizeof copy) ||
            std::memcmp(copy.magic, RefusedConnections::magic_text, sizeof copy.magic) != 0)
            continue;
        for (const auto& place : copy.place)
            if (place.taken != 0)
                state.refused.push_back({program, pid, printable_text(place.from), printable_text(place.to),
                                         printable_text(place.reason)});
    }
}

void RefusalReader::read(State& state, std::uint64_t now_ns) {
    std::set<std::uint32_t> present;
    for (const auto& [pid, program] : running_hosts(state)) {
        present.insert(pid);
        read_process(pid, program, state, now_ns);
    }
    std::erase_if(processes_, [&](const auto& process) { return present.count(process.first) == 0; });
}

} // namespace tandem::monitor
