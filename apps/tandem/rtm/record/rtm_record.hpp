// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/record/recording_options.hpp"
#include "apps/tandem/rtm/running/rtm_client.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

struct RtmRecordOptions : RecordingOptions {
    std::vector<std::string> ports;           ///< COMPONENT:PORT or COMPONENT; empty: all OutPorts
    std::vector<std::filesystem::path> types; ///< libraries with stubs of further data types
    std::vector<std::string> properties;      ///< of the connections, KEY=VALUE
};

/// Records OutPorts until a signal or the end of the duration. Returns the program's exit code. Throws
/// std::runtime_error with one line.
int rtm_record(const RtmClientOptions& client_options, const RtmRecordOptions& options);

} // namespace tandem::command
