// SPDX-License-Identifier: Apache-2.0
// Client of the lock-step protocol (step_server.hpp).
#pragma once

#include "host/rt/lock_step/line_socket.hpp"

#include <chrono>
#include <string>

namespace tandem::rt {

/// Lets a host run cycles of its components one at a time. Use it in one thread only.
class StepClient {
  public:
    /// Connects. If no server listens yet, waits for one up to `connect_timeout`. Throws std::runtime_error if there is
    /// none by then.
    StepClient(const std::string& socket_path, std::chrono::nanoseconds connect_timeout);

    /// Runs one cycle of the component and returns when it has ended. Throws std::runtime_error with the server's
    /// message if the cycle fails. Also throws if the server has closed the connection or has not replied within
    /// `reply_timeout`. The client is then unusable, because it would take a late reply for the next one.
    void step(const std::string& component,
              std::chrono::nanoseconds reply_timeout = std::chrono::seconds(10));

  private:
    std::string receive_line(std::chrono::nanoseconds reply_timeout);

    std::string path_;
    FileDescriptor socket_;
    LineBuffer lines_;
};

} // namespace tandem::rt
