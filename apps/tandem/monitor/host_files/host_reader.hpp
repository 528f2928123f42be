// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/host_files/inventory_reader.hpp"
#include "apps/tandem/monitor/host_files/usage_reader.hpp"
#include "apps/tandem/monitor/state.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace tandem::monitor {

/// Finds the running hosts, and reads what they list and how much of the machine they use. [one thread]
class HostReader {
  public:
    /// Further hosts without a link are not shown. State::unseen says so.
    static constexpr std::size_t max_hosts = 256;

    /// `without_links`: includes hosts of this user that are on no link.
    explicit HostReader(bool without_links) : without_links_(without_links) {}

    /// Fills in `state.hosts`. `now_ns`: CLOCK_MONOTONIC.
    void read(State& state, std::uint64_t now_ns);

  private:
    void look(const State& state);

    const bool without_links_;
    std::uint64_t next_look_ns_ = 0;
    std::set<std::uint32_t> linked_;             ///< at the last look
    std::map<std::uint32_t, std::string> found_; ///< pids and programs of processes with an inventory
    InventoryReader inventories_;
    UsageReader usage_;
};

} // namespace tandem::monitor
