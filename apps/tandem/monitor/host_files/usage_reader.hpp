// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace tandem::monitor {

/// Reads how much of the machine processes and their threads use, from /proc (proc(5)). [one thread]
class UsageReader {
  public:
    /// Fills in the usage of these hosts, and whether they are stopped; removes hosts that have ended. Shares of a processor
    /// are those of the last second or so; 0 at the first read. `now_ns`: CLOCK_MONOTONIC.
    void read(std::vector<HostState>& hosts, std::uint64_t now_ns);

  private:
    static constexpr std::size_t most_threads = 16; ///< of a host: the busiest
    struct Sample {
        std::uint64_t time_ns = 0, cpu_ns = 0;
    };
    using Key = std::pair<std::uint32_t, std::uint32_t>; ///< pid, and tid; tid 0: the process
    std::optional<HostUsage> read_host(std::uint32_t pid, std::uint64_t now_ns);
    std::vector<ThreadUsage> read_threads(std::uint32_t pid, std::uint64_t now_ns);
    double share(const Key& key, const Sample& now);

    std::map<Key, Sample> samples_, next_;      ///< of the previous reading, and of this one
    std::map<std::uint32_t, HostUsage> looked_; ///< at the last look
    std::uint64_t next_look_ns_ = 0;
    std::size_t looks_ = 0;
};

} // namespace tandem::monitor
