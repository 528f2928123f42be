// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/record/recording_options.hpp"

#include <string>
#include <vector>

namespace tandem::command {

struct RecordOptions : RecordingOptions {
    std::vector<std::string> links;
    std::vector<std::string> ports; ///< empty: all
};

/// Runs `tandem record` and returns the program's exit code. Errors are exceptions with a one-line message.
int record(const RecordOptions& options);

} // namespace tandem::command
