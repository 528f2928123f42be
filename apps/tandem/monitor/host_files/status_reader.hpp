// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"
#include "host/process/file_descriptor.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tandem::monitor {

/// Reads the states of components and the notices of hosts (host/process/published/component_states.hpp, notices.hpp), without
/// affecting the hosts. Notes hosts whose files this process cannot see. [one thread]
class StatusReader {
  public:
    /// Adds to `state` what the live processes of its links publish. `now_ns`: CLOCK_MONOTONIC.
    void read(State& state, std::uint64_t now_ns);

  private:
    struct Process {
        std::vector<process::FileDescriptor> components{}, notices{};
        std::uint64_t next_look_ns = 0;
        std::string unseen{}; ///< why its files cannot be listed
    };
    void look(Process& process, std::uint32_t pid, std::uint64_t now_ns);
    void note_unseen(const State& state, std::vector<std::string>& unseen) const;
    void read_process(std::uint32_t pid, const std::string& program, State& state, std::uint64_t now_ns);

    std::map<std::uint32_t, Process> processes_;
};

} // namespace tandem::monitor
