// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem shm`, a source file each. Each prints its result and returns the program's exit code;
// shm::Error and std::runtime_error are errors of one line. The texts of --help in shm_commands.cpp are their manual.
#pragma once
#include <cstdint>
#include <string>

namespace tandem::command {

int shm_list(bool json); ///< all segments of the machine
/// Header, sides and objects of one segment; generation 0 is the newest. 1 if it cannot be read.
int shm_info(const std::string& link, std::uint64_t generation, bool json);

/// Of `tandem shm stats`.
struct StatsOptions {
    std::string link;
    std::uint64_t generation = 0; ///< 0: the newest
    bool json = false;
    double period_s = 0;     ///< time between two observations; 0: a single one
    std::uint64_t count = 0; ///< observations with period_s > 0; 0: until interrupted
};
/// Counters, or from the second observation on their rates. 1 if the segment cannot be read.
int shm_stats(const StatsOptions& options);
/// Removes dead segments of a link, or with "" of all links.
/// Prints each segment that it removed and each that it left with the reason. Segments that a process holds, or of
/// another user, stay. Always 0; throws shm::Error for an impossible link name.
int shm_clean(const std::string& link, bool json);

} // namespace tandem::command
