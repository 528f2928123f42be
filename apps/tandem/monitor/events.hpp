// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace tandem::monitor {

struct Event {
    std::uint64_t number = 0;  ///< counts from 1 since the monitor started
    std::uint64_t time_ms = 0; ///< since the epoch
    bool bad = false;          ///< a failure; false: a start or a recovery
    std::string link, text;
};

/// Returns the events between two states, in the order of the links. Does not set numbers.
std::vector<Event> events_between(const State& before, const State& after);

/// The newest events, only in memory. [one thread]
class EventLog {
  public:
    static constexpr std::size_t capacity = 200;
    void add(std::vector<Event> events);
    const std::deque<Event>& events() const { return events_; } ///< oldest first

  private:
    std::deque<Event> events_;
    std::uint64_t count_ = 0;
};

} // namespace tandem::monitor
