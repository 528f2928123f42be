// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/options/probe_cli_options.hpp"
#include "host/options/real_time_options.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tandem::options {

/// The command line of opros_host.
struct OprosHostOptions {
    std::filesystem::path application;              ///< profile
    std::vector<std::filesystem::path> plugin_dirs; ///< --plugin-path
    std::string lockstep_socket;                    ///< empty: cycles run on timers
    std::string node;                               ///< empty: the profile's choice
    bool strict = false, stats = false;
    double grace_s = 10;
    RealTimeOptions real_time;
    ProbeCliOptions probe;

    std::chrono::nanoseconds grace() const {
        return std::chrono::nanoseconds(static_cast<std::int64_t>(grace_s * 1e9));
    }
};

/// Parses the command line. After --help, --version or a mistake, prints the text or the error, sets `exit_code`
/// to the program's exit code, and returns nothing.
std::optional<OprosHostOptions> parse_opros_host_options(int argc, char** argv, int& exit_code);

} // namespace tandem::options
