// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace tandem::command {

struct RecordOptions {
    std::vector<std::string> links;
    std::vector<std::string> ports;  ///< none: all
    std::string file;                ///< empty: LINK-DATE-TIME.mcap in the current folder
    std::string compression = "lz4"; ///< none, lz4 or zstd
    double duration_s = 0;           ///< 0: until SIGINT or SIGTERM
};

/// `tandem record`: returns the program's exit code; errors are exceptions of one line.
int record(const RecordOptions& options);

} // namespace tandem::command
