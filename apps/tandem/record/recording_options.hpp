// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/writer.hpp"

#include <string>

namespace CLI {
class App;
}

namespace tandem::command {

/// Options of all commands that record.
struct RecordingOptions {
    std::string file;                ///< empty: a name with date and time in the current folder
    std::string compression = "lz4"; ///< none, lz4 or zstd
    double duration_s = 0;           ///< 0: until SIGINT or SIGTERM
};
/// Interval of flushes in ns. Older data are in the file even if the process is killed.
inline constexpr std::uint64_t flush_interval_ns = 500'000'000;

void add_recording_options(CLI::App& command, RecordingOptions& options);
mcap::WriterOptions writer_options(const RecordingOptions& options);
/// Returns `options.file`, or NAME-DATE-TIME.mcap if it is empty.
std::string recording_file(const RecordingOptions& options, const std::string& name);

} // namespace tandem::command
