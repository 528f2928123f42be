// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace tandem::mcap {

struct Finding {
    bool error = true; ///< true: forbidden by the specification; false: some readers may fail
    std::string line;
};

/// Checks every record, CRC, index and count of a file against the specification and the rules of `mcap doctor`. Reads
/// the whole file and keeps one chunk in memory. Throws Error if the file cannot be read or is not MCAP.
std::vector<Finding> check_file(const std::filesystem::path& file);

} // namespace tandem::mcap
