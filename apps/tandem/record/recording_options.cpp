// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/record/recording_options.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <tandem_version.hpp>

#include <ctime>

namespace tandem::command {

mcap::WriterOptions writer_options(const RecordingOptions& options) {
    const auto compression = options.compression == "zstd"  ? mcap::Compression::zstd
                             : options.compression == "lz4" ? mcap::Compression::lz4
                                                            : mcap::Compression::none;
    return {.library = std::string("tandem ") + tandem::version, .compression = compression};
}

std::string recording_file(const RecordingOptions& options, const std::string& name) {
    if (!options.file.empty()) return options.file;
    return fmt::format("{}-{:%Y%m%d-%H%M%S}.mcap", name, fmt::localtime(std::time(nullptr)));
}

} // namespace tandem::command
