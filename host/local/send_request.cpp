// SPDX-License-Identifier: Apache-2.0
#include "host/local/send_request.hpp"

#include "host/local/frame_socket.hpp"
#include "host/process/file_descriptor.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <poll.h>
#include <sys/socket.h>
#include <thread>

namespace tandem::local {
namespace {

using Clock = std::chrono::steady_clock;
using process::FileDescriptor;

constexpr std::chrono::milliseconds pause_without_room{10};

/// Returns no descriptor if there is no room in the queue of the process until the deadline: poll() cannot wait for that.
FileDescriptor connect_to(const std::filesystem::path& socket, Clock::time_point deadline) {
    const sockaddr_un address = socket_address(socket);
    FileDescriptor fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    while (::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
        if (errno != EAGAIN) throw NobodyListens(socket.string() + ": " + std::strerror(errno));
        if (Clock::now() >= deadline) return {};
        std::this_thread::sleep_for(pause_without_room);
    }
    if (!peer_is_permitted(fd.get())) throw NobodyListens(socket.string() + " belongs to another user");
    return fd;
}

bool wait_for(int socket, short events, Clock::time_point deadline) {
    pollfd watched{socket, events, 0};
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        const int ready = ::poll(&watched, 1, static_cast<int>(std::clamp<long>(left, 0, 3'600'000)));
        if (ready >= 0) return ready > 0;
        if (errno != EINTR) return false;
    }
}

} // namespace

std::optional<std::string> send_request(const std::filesystem::path& socket, const std::string& request,
                                        std::chrono::milliseconds timeout) {
    const auto deadline = Clock::now() + timeout;
    std::string unsent = make_frame(request);
    const FileDescriptor fd = connect_to(socket, deadline);
    if (!fd) return std::nullopt;
    while (!unsent.empty()) {
        if (!send_some(fd.get(), unsent))
            throw NobodyListens(socket.string() + ": the connection was closed");
        if (!unsent.empty() && !wait_for(fd.get(), POLLOUT, deadline)) return std::nullopt;
    }
    FrameBuffer received;
    while (wait_for(fd.get(), POLLIN, deadline)) {
        const bool open = received.fill(fd.get());
        if (auto reply = received.take()) return reply;
        if (!open) throw NobodyListens(socket.string() + ": the connection was closed");
    }
    return std::nullopt;
}

} // namespace tandem::local
