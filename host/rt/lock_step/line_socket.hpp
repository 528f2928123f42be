// SPDX-License-Identifier: Apache-2.0
// Lines of text over a unix stream socket, for StepServer and StepClient. Internal to host/rt.
#pragma once

#include "host/process/file_descriptor.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <sys/un.h>

namespace tandem::rt {

using process::FileDescriptor;

/// Returns the path as an address. Throws std::runtime_error if it is empty or longer than an address can hold (107).
sockaddr_un socket_address(const std::string& path);

/// Collects received bytes and returns them line by line. The peer is not trusted: a line longer than 4096
/// bytes is an error.
class LineBuffer {
  public:
    /// Receives the available bytes without waiting. Returns false if the peer has closed the socket or sent an overlong
    /// line.
    bool fill(int fd);
    /// Returns the next complete line without its newline, if there is one.
    std::optional<std::string> take_line();

  private:
    std::string bytes_;
};

/// Sends the whole text. Returns false if the peer has closed the socket or has not read for one second. Raises no SIGPIPE.
bool send_all(int fd, std::string_view text);

} // namespace tandem::rt
