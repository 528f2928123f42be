// SPDX-License-Identifier: Apache-2.0
#include "host/local/frame_socket.hpp"
#include "host/local/local_endpoint.hpp"
#include "host/local/request_server.hpp"
#include "host/local/send_request.hpp"
#include "host/process/file_descriptor.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace tandem::local;
using namespace std::chrono_literals;
using tandem::process::FileDescriptor;

namespace {

constexpr auto long_enough = 30s;

/// Answers `hang` when it is released, and everything else with the request itself.
struct Scene {
    Scene() {
        RequestHandler handler;
        handler.answer = [this](const std::string& request) {
            while (request == "hang" && !released) std::this_thread::sleep_for(1ms);
            return "<" + request + ">";
        };
        handler.time_limit = [](const std::string& request) {
            return request == "hang" ? 50ms : std::chrono::milliseconds(long_enough);
        };
        handler.may_hang = [](const std::string& request) { return request == "hang"; };
        handler.late_reply = [](const std::string& request) { return request + " is late"; };
        handler.refusal = "too many";
        server.emplace(socket, std::move(handler));
    }
    ~Scene() {
        released = true;
        server->stop_within(long_enough);
    }
    FileDescriptor connect() const {
        FileDescriptor fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
        const sockaddr_un address = socket_address(socket);
        REQUIRE(::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
        return fd;
    }

    const std::filesystem::path socket = make_local_endpoint("test");
    std::atomic<bool> released{false};
    std::optional<RequestServer> server;
};

/// Returns whether the server closes the connection.
bool is_closed(const FileDescriptor& fd) {
    pollfd watched{fd.get(), POLLIN, 0};
    char byte = 0;
    return ::poll(&watched, 1, 30000) == 1 && ::recv(fd.get(), &byte, 1, 0) <= 0;
}

} // namespace

TEST_CASE("a request of any size up to the limit is answered") {
    const Scene scene;
    CHECK(send_request(scene.socket, "", long_enough) == "<>");
    const std::string large(max_frame_bytes - 2, 'x');
    CHECK(send_request(scene.socket, large, long_enough) == "<" + large + ">");
    CHECK_THROWS_AS(send_request(scene.socket, large + "yyy", long_enough), std::length_error);
}

TEST_CASE("a request that takes too long still gets its reply, and the server continues") {
    Scene scene;
    CHECK(send_request(scene.socket, "hang", long_enough) == "hang is late");
    CHECK(send_request(scene.socket, "next", long_enough) == "<next>");
    CHECK_FALSE(scene.server->stop_within(0s));
    scene.released = true;
    CHECK(scene.server->stop_within(long_enough));
}

TEST_CASE("the number of requests that have not ended is bounded") {
    Scene scene;
    std::string reply;
    for (int i = 0; i < 100 && reply != "too many"; ++i)
        reply = *send_request(scene.socket, "hang", long_enough);
    CHECK(reply == "too many");
    CHECK(send_request(scene.socket, "next", long_enough) == "<next>"); // does not hang, so it has a place
    scene.released = true;
    for (int i = 0; i < 10000 && reply != "<hang>"; ++i) {
        reply = *send_request(scene.socket, "hang", long_enough);
        std::this_thread::sleep_for(1ms);
    }
    CHECK(reply == "<hang>");
}

TEST_CASE(
    "a server that has stopped has destroyed its handler, although a thread may still know the server") {
    auto used = std::make_shared<int>(0);
    const std::weak_ptr<int> left = used;
    RequestHandler handler;
    handler.answer = [used = std::move(used)](const std::string& request) { return request; };
    handler.time_limit = [](const std::string&) { return std::chrono::milliseconds(long_enough); };
    handler.may_hang = [](const std::string&) { return false; };
    handler.late_reply = [](const std::string& request) { return request; };
    RequestServer server(make_local_endpoint("test"), std::move(handler));
    CHECK(server.stop_within(long_enough));
    CHECK(left.expired());
}

TEST_CASE("a process with a full queue of connections is alive, and does not answer in time") {
    const auto socket = make_local_endpoint("test");
    const sockaddr_un address = socket_address(socket);
    const auto to = reinterpret_cast<const sockaddr*>(&address);
    const FileDescriptor listener(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)); // accepts nobody
    REQUIRE(::bind(listener.get(), to, sizeof address) == 0);
    REQUIRE(::listen(listener.get(), 1) == 0);
    std::vector<FileDescriptor> clients;
    for (int error = 0; error == 0 && clients.size() < 100;) {
        clients.emplace_back(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
        error = ::connect(clients.back().get(), to, sizeof address) == 0 ? 0 : errno;
        CHECK((error == 0 || error == EAGAIN));
    }
    CHECK(send_request(socket, "next", 50ms) == std::nullopt);
    clients.clear(); // frees no place: the connections wait to be accepted
    CHECK(send_request(socket, "next", 50ms) == std::nullopt);
    ::unlink(socket.c_str());
}

TEST_CASE("a client that announces too much is cut off, and one that leaves or sends nothing disturbs no "
          "other client") {
    const Scene scene;
    const auto silent = scene.connect();
    { const auto leaves = scene.connect(); }
    const auto liar = scene.connect();
    REQUIRE(::send(liar.get(), "\xff\xff\xff\x7f", 4, MSG_NOSIGNAL) == 4);
    CHECK(is_closed(liar));
    CHECK(send_request(scene.socket, "next", long_enough) == "<next>");
    CHECK(is_closed(silent)); // after its time
}

TEST_CASE("the socket is only this user's, and gone with its server") {
    Scene scene;
    struct stat status {};
    REQUIRE(::stat(scene.socket.c_str(), &status) == 0);
    CHECK((status.st_mode & 0777) == 0600);
    REQUIRE(::stat(scene.socket.parent_path().c_str(), &status) == 0);
    CHECK((status.st_mode & 0777) == 0700);
    CHECK(scene.server->stop_within(long_enough));
    CHECK_FALSE(std::filesystem::exists(scene.socket));
    CHECK_THROWS_AS(send_request(scene.socket, "next", long_enough), NobodyListens);
}

TEST_CASE(
    "the socket of a killed process accepts no connection, even while its child lives, and is removed") {
    int started[2];
    REQUIRE(::pipe(started) == 0);
    const pid_t host = ::fork();
    if (host == 0) {
        const Scene scene;
        const pid_t child = ::fork();
        if (child == 0) std::this_thread::sleep_for(long_enough);
        const ssize_t written = ::write(started[1], &child, sizeof child);
        std::this_thread::sleep_for(long_enough);
        ::_exit(written == sizeof child ? 0 : 1);
    }
    pid_t child = 0;
    REQUIRE(::read(started[0], &child, sizeof child) == sizeof child);
    ::kill(host, SIGKILL);
    REQUIRE(::waitpid(host, nullptr, 0) == host);
    std::filesystem::path socket;
    for (const auto& endpoint : find_local_endpoints("test"))
        if (endpoint.pid == host) socket = endpoint.socket;
    REQUIRE(!socket.empty());
    CHECK_FALSE(accepts_connections(socket));
    ::kill(child, SIGKILL);
    remove_ended_endpoints("test");
    CHECK_FALSE(std::filesystem::exists(socket));
    ::close(started[0]);
    ::close(started[1]);
}
