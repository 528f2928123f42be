// SPDX-License-Identifier: Apache-2.0
#include "host/rt/lock_step/line_socket.hpp"

#include <cerrno>
#include <cstring>
#include <poll.h>
#include <stdexcept>
#include <sys/socket.h>
#include <unistd.h>

namespace tandem::rt {
namespace {
constexpr std::size_t max_line_bytes = 4096;
constexpr int send_timeout_ms = 1000;
} // namespace

sockaddr_un socket_address(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.empty() || path.size() >= sizeof address.sun_path)
        throw std::runtime_error("socket path '" + path + "' must have 1 to " +
                                 std::to_string(sizeof address.sun_path - 1) + " characters");
    std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
    return address;
}

bool LineBuffer::fill(int fd) {
    char chunk[512];
    const ssize_t got = ::recv(fd, chunk, sizeof chunk, MSG_DONTWAIT);
    if (got < 0) return errno == EAGAIN || errno == EINTR;
    if (got == 0) return false;
    bytes_.append(chunk, static_cast<std::size_t>(got));
    return bytes_.size() <= max_line_bytes || bytes_.find('\n') != std::string::npos;
}

std::optional<std::string> LineBuffer::take_line() {
    const std::size_t end = bytes_.find('\n');
    if (end == std::string::npos) return std::nullopt;
    std::string line = bytes_.substr(0, end);
    bytes_.erase(0, end + 1);
    return line;
}

bool send_all(int fd, std::string_view text) {
    while (!text.empty()) {
        const ssize_t sent = ::send(fd, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent > 0) {
            text.remove_prefix(static_cast<std::size_t>(sent));
            continue;
        }
        if (errno == EINTR) continue;
        pollfd writable{fd, POLLOUT, 0};
        if (errno != EAGAIN || ::poll(&writable, 1, send_timeout_ms) <= 0) return false;
    }
    return true;
}

} // namespace tandem::rt
