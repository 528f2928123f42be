// SPDX-License-Identifier: Apache-2.0
// Commands as a user types them, each bounded.
#pragma once

#include "host/process/run_command.hpp"

#include <chrono>
#include <string>

namespace tandem::test {

struct CommandOutput {
    int exit_code;
    std::string output; ///< standard output and error
};

/// Executes a command line of bash.
inline CommandOutput shell(const std::string& command) {
    const auto result = process::run_command({"bash", "-c", command},
                                             {.timeout = std::chrono::minutes(5), .merge_errors = true});
    return {result.exit_code(), result.output};
}

/// Runs a host until it has printed `ready` and `expected`, then ends it cleanly. `host` may have arguments.
/// Exit code 137: it was silent for a minute.
inline CommandOutput run_host(const std::string& host, const std::string& application,
                              const std::string& expected = "") {
    return shell("coproc " + host + " " + application +
                 "; pid=$COPROC_PID; while read -t 60 -r line || { end=$?; false; }; do echo \"$line\"; "
                 "said+=\"$line \"; [[ -z $asked && $said == *ready\\ * && $said == *\"" +
                 expected +
                 "\"* ]] && kill -TERM $pid && asked=1; done <&${COPROC[0]}; "
                 "[ $end -gt 128 ] && kill -KILL $pid; wait $pid");
}

} // namespace tandem::test
