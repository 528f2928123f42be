// SPDX-License-Identifier: Apache-2.0
// Frames over a Unix stream socket: a length of four bytes (little-endian), then as many bytes of text.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <sys/un.h>

namespace tandem::local {

/// The longest text of a frame.
inline constexpr std::size_t max_frame_bytes = 1 << 20;

/// Returns the path as an address. Throws std::runtime_error if it is longer than an address can hold (107).
sockaddr_un socket_address(const std::string& path);

/// Returns whether the process at the other end of a connection belongs to this user or to root. [any-thread]
bool peer_is_permitted(int socket);

/// Returns the frame of this text. Throws std::length_error if the text is too long.
std::string make_frame(const std::string& text);

/// Collects received bytes until a frame is complete. The sender is not trusted.
class FrameBuffer {
  public:
    /// Receives the available bytes without waiting. Returns false if the other end has closed the connection, or
    /// announces a frame that is too long.
    bool fill(int socket);
    /// Returns the text of the next complete frame, if there is one.
    std::optional<std::string> take();

  private:
    std::string bytes_;
};

/// Sends what fits without waiting, and removes it from `bytes`. Returns false if the other end has closed the
/// connection. Raises no SIGPIPE.
bool send_some(int socket, std::string& bytes);

} // namespace tandem::local
