// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"
#include "host/process/file_descriptor.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tandem::monitor {

/// Reads the connections that hosts refused (host/process/published/refused_connections.hpp), without affecting the hosts. [one
/// thread]
class RefusalReader {
  public:
    /// Fills `state.refused` for the live processes of its links. `now_ns`: CLOCK_MONOTONIC.
    void read(State& state, std::uint64_t now_ns);

  private:
    struct Process {
        std::vector<process::FileDescriptor> files{};
        std::uint64_t next_look_ns = 0;
    };
    void read_process(std::uint32_t pid, const std::string& program, State& state, std::uint64_t now_ns);

    std::map<std::uint32_t, Process> processes_;
};

} // namespace tandem::monitor
