// SPDX-License-Identifier: Apache-2.0
#include "host/rt/lock_step/step_server.hpp"

#include "host/process/start_thread.hpp"
#include "host/rt/thread.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <poll.h>
#include <stdexcept>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace tandem::rt {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
    throw std::runtime_error("lock-step socket '" + path + "': " + what);
}

// A socket file remains when its process is killed, and bind() fails on it. Only an attempt to connect shows whether a
// process listens. A file that is not a socket is left alone.
void remove_stale_socket(const std::string& path, const sockaddr_un& address) {
    const FileDescriptor probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const auto* where = reinterpret_cast<const sockaddr*>(&address);
    if (::connect(probe.get(), where, sizeof address) == 0) fail(path, "another process listens on it");
    struct stat info {};
    if (::stat(path.c_str(), &info) == 0 && S_ISSOCK(info.st_mode)) ::unlink(path.c_str());
}

FileDescriptor listen_on(const std::string& path) {
    const sockaddr_un address = socket_address(path);
    remove_stale_socket(path, address);
    FileDescriptor listener(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    ::fchmod(listener.get(), 0600); // before bind: the file never has a wider mode
    const auto* where = reinterpret_cast<const sockaddr*>(&address);
    if (::bind(listener.get(), where, sizeof address) != 0) fail(path, std::strerror(errno));
    if (::listen(listener.get(), 8) != 0) fail(path, std::strerror(errno));
    return listener;
}

// A reply is one line.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

} // namespace

StepServer::StepServer(const std::string& socket_path, Step step)
    : path_(socket_path), step_(std::move(step)), listener_(listen_on(socket_path)),
      stop_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    thread_ = process::start_thread([this] { serve(); });
}

StepServer::~StepServer() {
    const std::uint64_t one = 1;
    if (::write(stop_.get(), &one, sizeof one) == sizeof one) thread_.join();
    ::unlink(path_.c_str());
}

void StepServer::serve() {
    configure_this_thread({"lockstep", 0, -1});
    while (wait_for_input()) {
    }
}

bool StepServer::wait_for_input() {
    std::vector<pollfd> watched{{stop_.get(), POLLIN, 0}, {listener_.get(), POLLIN, 0}};
    for (const Client& client : clients_) watched.push_back({client.socket.get(), POLLIN, 0});
    if (::poll(watched.data(), watched.size(), -1) < 0) return errno == EINTR;
    if (watched[0].revents != 0) return false;
    auto client = clients_.begin();
    // `watched` does not yet contain clients accepted below, so both lists are walked before accepting.
    for (std::size_t i = 2; i < watched.size(); ++i) {
        const bool keep = watched[i].revents == 0 || answer(*client);
        client = keep ? std::next(client) : clients_.erase(client);
    }
    if (watched[1].revents != 0) accept_one();
    return true;
}

void StepServer::accept_one() {
    FileDescriptor socket(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
    if (socket.get() >= 0) clients_.push_back({std::move(socket), {}});
}

bool StepServer::answer(Client& client) {
    if (!client.lines.fill(client.socket.get())) return false;
    while (auto request = client.lines.take_line())
        if (!send_all(client.socket.get(), reply_to(*request))) return false;
    return true;
}

std::string StepServer::reply_to(const std::string& request) {
    constexpr std::string_view verb = "step ";
    if (request.compare(0, verb.size(), verb) != 0)
        return "error unknown request '" + request + "', expected 'step NAME'\n";
    try {
        step_(request.substr(verb.size()));
        return "ok\n";
    } catch (const std::exception& error) {
        return "error " + one_line(error.what()) + "\n";
    }
}

} // namespace tandem::rt
