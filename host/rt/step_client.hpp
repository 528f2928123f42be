// SPDX-License-Identifier: Apache-2.0
// Client of the lock-step protocol (step_server.hpp).
#pragma once

#include "host/rt/line_socket.hpp"

#include <chrono>
#include <string>

namespace tandem::rt {

/// Lets a host run cycles of its components one at a time. For one thread.
class StepClient {
  public:
    /// Connects, and waits up to `connect_timeout` for a server that does not listen yet. Throws
    /// std::runtime_error when there is none by then.
    StepClient(const std::string& socket_path, std::chrono::nanoseconds connect_timeout);

    /// Runs one cycle of the component and returns when it has ended. Throws std::runtime_error with the
    /// server's message when the cycle fails. Also throws when the server has closed or has not replied
    /// within `reply_timeout`: the client cannot be used any further then, since a late reply would be taken
    /// for the next.
    void step(const std::string& component,
              std::chrono::nanoseconds reply_timeout = std::chrono::seconds(10));

  private:
    std::string receive_line(std::chrono::nanoseconds reply_timeout);

    std::string path_;
    FileDescriptor socket_;
    LineBuffer lines_;
};

} // namespace tandem::rt
