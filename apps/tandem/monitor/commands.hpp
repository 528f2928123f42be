// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace tandem::command {

struct MonitorOptions {
    std::vector<std::string> links; ///< none: all
    std::uint16_t port = 8080;      ///< 0: the kernel chooses one
    std::string bind = "127.0.0.1";
    std::vector<std::string>
        other_origins;    ///< of pages that may look by foxglove.websocket.v1, `https://app.example.org`
    bool control = false; ///< who has the token that is printed may activate, connect, record and drive
};
/// Serves the page until SIGINT or SIGTERM. Returns the exit code; throws std::runtime_error, one line, if it cannot listen.
int monitor(const MonitorOptions& options);

} // namespace tandem::command
