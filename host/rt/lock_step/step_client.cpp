// SPDX-License-Identifier: Apache-2.0
#include "host/rt/lock_step/step_client.hpp"

#include <cerrno>
#include <cstring>
#include <poll.h>
#include <stdexcept>
#include <sys/socket.h>
#include <thread>

namespace tandem::rt {
namespace {

using Clock = std::chrono::steady_clock;

int remaining_ms(Clock::time_point deadline) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    return left > 0 ? static_cast<int>(left) : 0;
}

} // namespace

StepClient::StepClient(const std::string& socket_path, std::chrono::nanoseconds connect_timeout)
    : path_(socket_path) {
    const sockaddr_un address = socket_address(path_);
    const auto* where = reinterpret_cast<const sockaddr*>(&address);
    const auto deadline = Clock::now() + connect_timeout;
    for (;;) {
        // Uses a new socket for each attempt: after a failed connect() the state of the old socket is unspecified.
        socket_ = FileDescriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
        if (::connect(socket_.get(), where, sizeof address) == 0) return;
        const std::string reason = std::strerror(errno);
        if (Clock::now() >= deadline)
            throw std::runtime_error("lock-step socket '" + path_ + "': no server listens: " + reason);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

std::string StepClient::receive_line(std::chrono::nanoseconds reply_timeout) {
    const auto deadline = Clock::now() + reply_timeout;
    for (;;) {
        if (auto line = lines_.take_line()) return *line;
        pollfd readable{socket_.get(), POLLIN, 0};
        const int ready = ::poll(&readable, 1, remaining_ms(deadline));
        if (ready < 0 && errno == EINTR) continue;
        if (ready == 0) throw std::runtime_error("lock-step server '" + path_ + "' did not answer in time");
        if (!lines_.fill(socket_.get())) throw std::runtime_error("lock-step server '" + path_ + "' is gone");
    }
}

void StepClient::step(const std::string& component, std::chrono::nanoseconds reply_timeout) {
    if (!send_all(socket_.get(), "step " + component + "\n"))
        throw std::runtime_error("lock-step server '" + path_ + "' is gone");
    const std::string reply = receive_line(reply_timeout);
    if (reply == "ok") return;
    constexpr std::string_view verb = "error ";
    const bool error = reply.compare(0, verb.size(), verb) == 0;
    throw std::runtime_error(error ? reply.substr(verb.size()) : "lock-step server sent '" + reply + "'");
}

} // namespace tandem::rt
