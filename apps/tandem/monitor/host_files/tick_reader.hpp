// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"
#include "host/process/file_descriptor.hpp"
#include "host/rt/tick_page.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace tandem::monitor {

/// A tick hangs if it is overdue by more than this number of periods and more than this time in ns. The time is long
/// because a machine without a real-time kernel can stall for a moment. Transition callbacks such as onActivated may
/// take longer; the hosts also report a hang after 16 s.
inline constexpr double hanging_periods = 3, hanging_ns = 0.6e9, hanging_transition_ns = 16e9;

/// Reads the tick counters of hosts (host/rt/tick_page.hpp), without affecting the hosts. [one thread]
class TickReader {
  public:
    /// Fills `state.ticks` for the live processes of its links. `now_ns`: CLOCK_MONOTONIC.
    void read(State& state, std::uint64_t now_ns);

  private:
    using Key = std::tuple<std::uint32_t, std::size_t, std::size_t>; ///< pid, page, slot
    struct Process {
        std::vector<process::FileDescriptor> pages{};
        std::uint64_t next_look_ns = 0; ///< time to search for new pages
    };
    using Sample = std::pair<std::uint64_t, rt::TickSlot>;

    void read_process(std::uint32_t pid, const std::string& program, State& state, std::uint64_t now_ns);
    TickState describe(const std::deque<Sample>& samples) const;

    std::map<std::uint32_t, Process> processes_;
    std::map<Key, std::deque<Sample>> samples_; ///< oldest first
};

} // namespace tandem::monitor
