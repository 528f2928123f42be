// SPDX-License-Identifier: Apache-2.0
// Lines over a unix stream socket: what StepServer and StepClient share. Internal to host/rt.
#pragma once

#include "host/process/file_descriptor.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <sys/un.h>

namespace tandem::rt {

using process::FileDescriptor;

/// Throws std::runtime_error when the path is longer than a unix socket address can hold.
sockaddr_un socket_address(const std::string& path);

/// Collects received bytes and hands them out line by line; a line longer than 4096 bytes is refused.
class LineBuffer {
  public:
    /// False: the peer is gone or has sent an overlong line. Does not block beyond what the socket has ready.
    bool fill(int fd);
    std::optional<std::string> take_line();

  private:
    std::string bytes_;
};

/// Sends everything, without SIGPIPE; false when the peer is gone or does not read for a second.
bool send_all(int fd, std::string_view text);

} // namespace tandem::rt
