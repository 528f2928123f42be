// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace tandem::command {

struct MonitorOptions {
    std::vector<std::string> links; ///< empty: all
    std::uint16_t port = 8080;      ///< 0: chosen by the kernel
    std::string bind = "127.0.0.1";
    std::vector<std::string>
        other_origins; ///< origins of pages that may use foxglove.websocket.v1, e.g. https://app.example.org
    std::vector<std::string> allowed_hosts; ///< names by which clients may address the monitor
    std::string systems;  ///< folder of systems that clients with the token may create and run; empty: none
    bool control = false; ///< print a token that permits to activate, connect, record and drive
};
/// Serves the page until SIGINT or SIGTERM. Returns the exit code. Throws std::runtime_error with one line if it cannot
/// listen.
int monitor(const MonitorOptions& options);

} // namespace tandem::command
