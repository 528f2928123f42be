// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/record/recording_options.hpp"

#include <string>
#include <vector>

namespace tandem::command {

struct RecordOptions : RecordingOptions {
    std::vector<std::string> links;
    std::vector<std::string> ports; ///< none: all
};

/// `tandem record`: returns the program's exit code; errors are exceptions of one line.
int record(const RecordOptions& options);

} // namespace tandem::command
