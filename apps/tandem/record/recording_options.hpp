// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/writer.hpp"

#include <string>

namespace CLI {
class App;
}

namespace tandem::command {

/// What all commands that record have.
struct RecordingOptions {
    std::string file;                ///< empty: a name with date and time in the current folder
    std::string compression = "lz4"; ///< none, lz4 or zstd
    double duration_s = 0;           ///< 0: until SIGINT or SIGTERM
};
/// After this long, what was written is in the file, whatever happens to the process; in ns.
inline constexpr std::uint64_t flush_interval_ns = 500'000'000;

void add_recording_options(CLI::App& command, RecordingOptions& options);
mcap::WriterOptions writer_options(const RecordingOptions& options);
/// `options.file`, or else NAME-DATE-TIME.mcap.
std::string recording_file(const RecordingOptions& options, const std::string& name);

} // namespace tandem::command
