// SPDX-License-Identifier: Apache-2.0
#include "host/local/frame_socket.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <sys/socket.h>
#include <unistd.h>

namespace tandem::local {
namespace {

constexpr std::size_t length_bytes = 4;

// The length of the first frame in `bytes`, which has at least length_bytes.
std::size_t announced_length(const std::string& bytes) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < length_bytes; ++i)
        length |= static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    return length;
}

} // namespace

sockaddr_un socket_address(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.empty() || path.size() >= sizeof address.sun_path)
        throw std::runtime_error("socket '" + path + "': its path has " + std::to_string(path.size()) +
                                 " bytes, 1 to 107 are expected; set XDG_RUNTIME_DIR to a shorter path");
    path.copy(address.sun_path, sizeof address.sun_path); // a 0 follows
    return address;
}

bool peer_is_permitted(int socket) {
    ucred peer{};
    socklen_t size = sizeof peer;
    return ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 && size == sizeof peer &&
           (peer.uid == ::geteuid() || peer.uid == 0);
}

std::string make_frame(const std::string& text) {
    if (text.size() > max_frame_bytes) throw std::length_error("a message is longer than 1 MiB");
    std::string frame;
    frame.reserve(length_bytes + text.size());
    for (std::size_t i = 0; i < length_bytes; ++i) frame.push_back(static_cast<char>(text.size() >> (8 * i)));
    return frame + text;
}

bool FrameBuffer::fill(int socket) {
    std::array<char, 4096> chunk;
    for (;;) {
        const ssize_t got = ::recv(socket, chunk.data(), chunk.size(), MSG_DONTWAIT);
        if (got < 0) return errno == EAGAIN || errno == EINTR;
        if (got == 0) return false;
        bytes_.append(chunk.data(), static_cast<std::size_t>(got));
        if (bytes_.size() >= length_bytes && announced_length(bytes_) > max_frame_bytes) return false;
        if (bytes_.size() > length_bytes + max_frame_bytes) return false;
    }
}

std::optional<std::string> FrameBuffer::take() {
    if (bytes_.size() < length_bytes) return std::nullopt;
    const std::size_t length = announced_length(bytes_);
    if (bytes_.size() < length_bytes + length) return std::nullopt;
    std::string text = bytes_.substr(length_bytes, length);
    bytes_.erase(0, length_bytes + length);
    return text;
}

bool send_some(int socket, std::string& bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(socket, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent < 0) return errno == EAGAIN || errno == EINTR;
        bytes.erase(0, static_cast<std::size_t>(sent));
    }
    return true;
}

} // namespace tandem::local
