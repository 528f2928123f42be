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

/// A tick hangs that is due for longer than this: so many periods, and so much time, since a machine without a real-time
/// kernel may stand still for a moment. A callback of a transition, as onActivated, may take longer: the hosts, too, say that
/// it hangs after 16 s.
inline constexpr double hanging_periods = 3, hanging_ns = 1e9, hanging_transition_ns = 16e9;

/// Reads the counters of ticks that hosts keep (host/rt/tick_page.hpp). The hosts do not notice. [one thread]
class TickReader {
  public:
    /// Fills `state.ticks` for the processes that live in its links; `now_ns`: CLOCK_MONOTONIC.
    void read(State& state, std::uint64_t now_ns);

  private:
    static constexpr std::size_t max_pages = 8; ///< of one process: one for each library that has ticks
    using Key = std::tuple<std::uint32_t, std::size_t, std::size_t>; ///< pid, page, slot
    struct Process {
        std::vector<process::FileDescriptor> pages{};
        std::uint64_t next_look_ns = 0; ///< for pages that have come
    };
    using Sample = std::pair<std::uint64_t, rt::TickSlot>;

    void read_process(std::uint32_t pid, const std::string& program, State& state, std::uint64_t now_ns);
    TickState describe(const std::deque<Sample>& samples) const;

    std::map<std::uint32_t, Process> processes_;
    std::map<Key, std::deque<Sample>> samples_; ///< oldest first
};

} // namespace tandem::monitor
