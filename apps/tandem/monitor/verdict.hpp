// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <string>
#include <vector>

namespace tandem::monitor {

/// From good to bad.
enum class Level {
    well,
    unseen,
    setting,
    inactive,
    no_link,
    mismatch,
    waiting,
    missing,
    unrecorded,
    late,
    dropping,
    overrun,
    unreadable,
    failed,
    stopped,
    gone,
    dead,
    hanging
};

const char* name_of(Level level); ///< name in the JSON: `well`, `no_link` ...
inline constexpr Level worst_level = Level::hanging;

/// Returns what a level means, in a few words.
const char* text_of(Level level);

struct Finding {
    Level level{};
    std::string reason; ///< one line: place and amount
};

struct Verdict {
    static constexpr std::size_t max_worst = 20;
    Level level = Level::well;
    std::string text;             ///< the verdict in a few words
    std::string reason;           ///< of the worst finding
    std::size_t findings = 0;     ///< of all levels
    std::vector<Finding> worst{}; ///< from bad to good; of one level, in the order of the links
};

/// Shares of a component's recent ticks that overrun. From the first share, the component is late; from the second, it
/// does not keep its period. Both need a few overruns, because single ones are normal without a real-time kernel.
inline constexpr double late_share = 0.01, overrun_share = 0.1;
inline constexpr std::uint64_t few_overruns = 3;

/// Describes a hanging tick: component, host, callback, and since when (local time).
std::string describe_hang(const TickState& tick);

/// Time after which an event-driven component hangs that does not return from its cycle. It is the time after which the
/// hosts report a callback that takes long.
inline constexpr double hanging_cycle_s = 16;

/// Returns whether an event-driven component hangs.
inline bool hangs(const ComponentStatus& component) { return component.in_cycle_s > hanging_cycle_s; }

/// Describes a component that hangs or is not active.
std::string describe_component(const ComponentStatus& component);

/// Returns the worst finding about the links. If several findings have the same level, the first link's counts.
Verdict judge(const State& state);

} // namespace tandem::monitor
