// SPDX-License-Identifier: Apache-2.0
// Commands as a user types them, each bounded.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <sys/wait.h>

namespace tandem::test {

struct CommandOutput {
    int exit_code;
    std::string output; ///< standard output and error
};

/// By bash; no single quotes in the command.
inline CommandOutput shell(const std::string& command) {
    std::FILE* pipe = popen(("exec bash -c '" + command + "' 2>&1 </dev/null").c_str(), "r");
    if (!pipe) return {-1, "no shell"};
    std::string output;
    std::array<char, 4096> chunk;
    while (const auto got = std::fread(chunk.data(), 1, chunk.size(), pipe)) output.append(chunk.data(), got);
    const int status = pclose(pipe);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output};
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
