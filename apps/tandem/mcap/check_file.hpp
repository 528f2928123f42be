// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace tandem::mcap {

struct Finding {
    bool error = true; ///< the specification forbids it; otherwise readers may stumble over it
    std::string line;
};

/// Everything that is wrong with a file, by the specification and the rules of `mcap doctor`: every record, CRC, index
/// and count. Reads the whole file; one chunk at a time is in memory. Throws Error if it cannot be read or is not MCAP.
std::vector<Finding> check_file(const std::filesystem::path& file);

} // namespace tandem::mcap
