// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/run/service_manager.hpp"

#include "host/process/file_descriptor.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <systemd/sd-daemon.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace tandem::command {
namespace {

using namespace std::chrono_literals;

/// Like sd_notify(3), but waits at most `bound` if the service manager does not read, and then drops the message. The
/// hosts need supervision meanwhile.
void notify(const std::string& message, std::chrono::microseconds bound) {
    const char* const path = std::getenv("NOTIFY_SOCKET");
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path == nullptr || *path == 0) return;
    const std::size_t length = std::string(path).copy(address.sun_path, sizeof address.sun_path - 1);
    if (address.sun_path[0] == '@') address.sun_path[0] = 0; // abstract address, see unix(7)
    const process::FileDescriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    const timeval limit{0, bound.count()};
    setsockopt(socket.get(), SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
    sendto(socket.get(), message.data(), message.size(), MSG_NOSIGNAL | (bound == 0us ? MSG_DONTWAIT : 0),
           reinterpret_cast<const sockaddr*>(&address),
           static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + length));
}

constexpr auto no_wait = 0us, short_wait = 500'000us;

} // namespace

ServiceManager::ServiceManager() {
    std::uint64_t limit_us = 0;
    if (sd_watchdog_enabled(0, &limit_us) > 0) pause_ = std::chrono::microseconds(limit_us / 4);
}

void ServiceManager::report_ready() { notify("READY=1", short_wait); }

void ServiceManager::report_stopping() { notify("STOPPING=1", short_wait); }

void ServiceManager::report_status(const std::string& line) {
    std::string text = line;
    std::replace(text.begin(), text.end(), '\n', ' '); // a newline starts another assignment
    notify("STATUS=" + text, no_wait);
}

void ServiceManager::keep_alive() {
    if (pause_.count() == 0) return;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + pause_;
    notify("WATCHDOG=1", no_wait);
}

} // namespace tandem::command
