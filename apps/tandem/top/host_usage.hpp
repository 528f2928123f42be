// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tandem::command {

/// A host's use of the machine according to proc(5).
struct HostUsage {
    std::uint32_t pid = 0;
    std::string program;
    double cpu_percent = 0; ///< of one core, since the last read; 0 at the first
    std::uint64_t resident_bytes = 0;
    unsigned threads = 0;
    std::vector<std::string> links;
};

/// Reads the usage of hosts repeatedly. [one thread]
class HostUsageReader {
  public:
    /// Returns the usage of the running processes on these links, by pid. `now_ns`: CLOCK_MONOTONIC.
    std::vector<HostUsage> read(const monitor::State& state, std::uint64_t now_ns);

  private:
    struct Sample {
        std::uint64_t time_ns = 0, cpu_ns = 0;
    };
    std::map<std::uint32_t, Sample> samples_;
};

} // namespace tandem::command
