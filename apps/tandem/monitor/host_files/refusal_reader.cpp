// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/host_files/refusal_reader.hpp"

#include "apps/tandem/monitor/host_files/process_files.hpp"
#include "host/process/published/refused_connections.hpp"

namespace tandem::monitor {

using process::RefusedConnections;

void RefusalReader::read_process(std::uint32_t pid, const std::string& program, State& state,
                                 std::uint64_t now_ns) {
    Process& process = processes_[pid];
    if (now_ns >= process.next_look_ns) {
        process.next_look_ns = now_ns + file_search_pause_ns;
        process.files = open_memory_files(pid, RefusedConnections::file_name, sizeof(RefusedConnections));
    }
    for (const auto& descriptor : process.files) {
        const auto file = read_memory_file<RefusedConnections>(descriptor);
        if (!file) continue;
        for (const auto& place : file->place)
            if (place.taken != 0)
                state.refused.push_back({program, pid, printable_text(place.from), printable_text(place.to),
                                         printable_text(place.reason)});
    }
}

void RefusalReader::read(State& state, std::uint64_t now_ns) {
    read_running_hosts(state, processes_, [&](std::uint32_t pid, const std::string& program) {
        read_process(pid, program, state, now_ns);
    });
}

} // namespace tandem::monitor
