// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <string>

namespace tandem::monitor {

/// From good to bad.
enum class Level { well, no_link, mismatch, waiting, late, dropping, unreadable, stopped, gone, dead };

const char* name_of(Level level); ///< of the JSON: `well`, `no_link` ...

struct Verdict {
    Level level = Level::well;
    std::string text;         ///< what it is, in a few words
    std::string reason;       ///< one line: where, and how much
    std::size_t findings = 0; ///< of all levels; the worst is the one that is told
};

/// The worst that is to be said of the links; of several findings of one level, the first link's.
Verdict judge(const State& state);

} // namespace tandem::monitor
