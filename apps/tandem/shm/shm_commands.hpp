// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem shm`, one source file each. Each function prints its result and returns the exit code.
// They throw shm::Error and std::runtime_error with a one-line message. The help texts in shm_commands.cpp are their
// manual.
#pragma once
#include <cstdint>
#include <string>

namespace tandem::command {

int shm_list(bool json); ///< Lists all segments of the machine.
/// Prints header, sides and objects of a segment; generation 0 is the newest. Returns 1 if it is unreadable.
int shm_info(const std::string& link, std::uint64_t generation, bool json);

/// Options of `tandem shm stats`.
struct StatsOptions {
    std::string link;
    std::uint64_t generation = 0; ///< 0: the newest
    bool json = false;
    double period_s = 0;     ///< time between two observations; 0: a single one
    std::uint64_t count = 0; ///< number of observations with period_s > 0; 0: until interrupted
};
/// Prints counters, or their rates from the second observation on. Returns 1 if the segment is unreadable.
int shm_stats(const StatsOptions& options);
/// Removes dead segments of a link, or of all links if `link` is "". Prints the removed segments, and the others with
/// the reason. Keeps segments that a process holds or that belong to another user. Returns 0. Throws shm::Error for an
/// invalid link name.
int shm_clean(const std::string& link, bool json);

} // namespace tandem::command
