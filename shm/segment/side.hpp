// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

namespace tandem::shm {

/// The two sides of a link. A process takes one of them. shm attaches no meaning to the choice.
enum class Side : std::uint32_t { first, second };

constexpr Side other(Side side) { return side == Side::first ? Side::second : Side::first; }
constexpr std::size_t index_of(Side side) { return static_cast<std::size_t>(side) & 1U; }
constexpr const char* name_of(Side side) { return side == Side::first ? "first" : "second"; }

/// absent: never joined this generation. stopped: alive, but a signal or a debugger has stopped the process; only observers
/// report this. dead: had joined, and its lock is free. side_lives() distinguishes alive from dead.
enum class PeerState { absent, alive, stopped, dead };

} // namespace tandem::shm
