// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/host_files/host_reader.hpp"
#include "apps/tandem/monitor/host_files/refusal_reader.hpp"
#include "apps/tandem/monitor/host_files/status_reader.hpp"
#include "apps/tandem/monitor/host_files/tick_reader.hpp"
#include "apps/tandem/monitor/link_reader.hpp"
#include "apps/tandem/monitor/round.hpp"
#include "apps/tandem/monitor/state.hpp"

#include <atomic>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tandem::monitor {

/// Reads the newest generation of every link of the machine. Does not write, wake or lock anything. [one thread]
class StateReader {
  public:
    /// Further links are not read. State::cut says so.
    static constexpr std::size_t max_links = 256;

    /// Reads the links with these names and their hosts, or all links and hosts if `links` is empty.
    /// `stop`: ends a round early; null: nothing does. `bounds`: of each round.
    explicit StateReader(std::vector<std::string> links = {}, const std::atomic<bool>* stop = nullptr,
                         const RoundBounds& bounds = {})
        : wanted_(links.begin(), links.end()), stop_(stop), bounds_(bounds), hosts_(links.empty()) {}

    /// Without /dev/shm, the returned state has an error. Links for which the round has no time are as in `before`, the
    /// previous state; the next round begins with them.
    State read(const State& before = {});

  private:
    std::set<std::string> list_links(State& state) const;
    void read_links(const std::set<std::string>& names, const State& before, State& state);
    void check_wanted(State& state) const;
    void read_link(const std::string& name, State& state, Round& round);

    std::set<std::string> wanted_;
    const std::atomic<bool>* stop_;
    const RoundBounds bounds_;
    std::string first_; ///< link that the next round begins with
    std::map<std::string, LinkReader> links_;
    HostReader hosts_;
    TickReader ticks_;
    RefusalReader refusals_;
    StatusReader statuses_;
};

} // namespace tandem::monitor
