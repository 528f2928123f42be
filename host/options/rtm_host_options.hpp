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

/// The command line of rtm_host.
struct RtmHostOptions {
    std::string conf_file, port;       ///< -f, -p
    std::string lockstep_socket;       ///< empty: cycles run on timers
    std::vector<std::string> settings; ///< -o, each KEY:VALUE
    std::vector<std::filesystem::path> plugin_path;
    bool master = false, conf_file_may_be_missing = false, no_corba_servant = false;
    double grace_s = 10;
    ProbeCliOptions probe;
    RealTimeOptions real_time;

    std::chrono::nanoseconds grace() const {
        return std::chrono::nanoseconds(static_cast<std::int64_t>(grace_s * 1e9));
    }
};

/// Parses the command line. After --help, --version or a mistake, prints the text or the error, sets `exit_code` to the
/// program's exit code, and returns nothing.
std::optional<RtmHostOptions> parse_rtm_host_options(int argc, char** argv, int& exit_code);

} // namespace tandem::options
