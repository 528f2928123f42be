// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/host_files/refusal_reader.hpp"
#include "apps/tandem/monitor/host_files/tick_reader.hpp"
#include "apps/tandem/monitor/link_reader.hpp"
#include "apps/tandem/monitor/state.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace tandem::monitor {

/// Reads the newest generation of every link of the machine. Does not write, wake or lock anything. [one thread]
class StateReader {
  public:
    /// Further links are not read and not mentioned.
    static constexpr std::size_t max_links = 256;

    /// Reads the links with these names, or all if `links` is empty.
    explicit StateReader(std::vector<std::string> links = {}) : wanted_(links.begin(), links.end()) {}

    /// Without /dev/shm, the returned state has an error.
    State read();

  private:
    void read_link(const std::string& name, State& state);

    std::set<std::string> wanted_;
    std::map<std::string, LinkReader> links_;
    TickReader ticks_;
    RefusalReader refusals_;
};

} // namespace tandem::monitor
