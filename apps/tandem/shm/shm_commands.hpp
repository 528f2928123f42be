// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem shm`. Each returns the program's exit code; the texts of --help in
// shm_commands.cpp are their manual.
#pragma once
#include <cstdint>
#include <string>

namespace tandem::command {

int shm_list(bool json);
int shm_info(const std::string& link, std::uint64_t generation, bool json);

struct StatsOptions {
    std::string link;
    std::uint64_t generation = 0; ///< 0: the newest
    bool json = false;
    double period_s = 0;     ///< seconds from look to look; 0: one look
    std::uint64_t count = 0; ///< of looks; 0: until interrupted
};
int shm_stats(const StatsOptions& options);
int shm_clean(const std::string& link, bool json); ///< "": all links
int shm_doctor(bool json);

} // namespace tandem::command
