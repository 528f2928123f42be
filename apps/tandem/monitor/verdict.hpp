// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <string>

namespace tandem::monitor {

/// From good to bad.
enum class Level {
    well,
    no_link,
    mismatch,
    waiting,
    late,
    dropping,
    overrun,
    unreadable,
    stopped,
    gone,
    dead,
    hanging
};

const char* name_of(Level level); ///< of the JSON: `well`, `no_link` ...

struct Verdict {
    Level level = Level::well;
    std::string text;         ///< what it is, in a few words
    std::string reason;       ///< one line: where, and how much
    std::size_t findings = 0; ///< of all levels; the worst is the one that is told
};

/// Shares of a component's ticks that overrun in the last seconds: from the first on it is late, from the second on it does
/// not keep its period, if that has happened a few times. A single overrun on a machine without a real-time kernel is neither.
inline constexpr double late_share = 0.01, overrun_share = 0.1;
inline constexpr std::uint64_t few_overruns = 3;

/// What is to be said of a tick that hangs: component, host, callback, since when (local time).
std::string describe_hang(const TickState& tick);

/// The worst that is to be said of the links; of several findings of one level, the first link's.
Verdict judge(const State& state);

} // namespace tandem::monitor
