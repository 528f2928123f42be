// SPDX-License-Identifier: Apache-2.0
// The conductor's end of the lock-step protocol (step_server.hpp).
#pragma once

#include "host/rt/line_socket.hpp"

#include <chrono>
#include <string>

namespace tandem::rt {

class StepClient {
  public:
    /// Connects, waiting up to `connect_timeout` for a server to listen. Throws std::runtime_error when none
    /// does.
    StepClient(const std::string& socket_path, std::chrono::nanoseconds connect_timeout);

    /// One cycle of the component. Throws std::runtime_error with the server's message, when the server is
    /// gone, or when it has not answered within `reply_timeout`; after the latter two the client is of no further
    /// use.
    void step(const std::string& component,
              std::chrono::nanoseconds reply_timeout = std::chrono::seconds(10));

  private:
    std::string receive_line(std::chrono::nanoseconds reply_timeout);

    std::string path_;
    FileDescriptor socket_;
    LineBuffer lines_;
};

} // namespace tandem::rt
