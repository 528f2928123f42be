// SPDX-License-Identifier: Apache-2.0
// Connections of a test to a host, and what the host sends and reads.
#pragma once
#include "giop_message.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

namespace testing {

/// Sockets of the test, closed at the end.
class Sockets {
  public:
    ~Sockets() {
        for (const int fd : all_) close(fd);
    }
    int open(const std::string& port) {
        const int fd = connect_loopback(port);
        REQUIRE(fd >= 0);
        all_.push_back(fd);
        return fd;
    }

  private:
    std::vector<int> all_;
};

/// Returns whether the host ends the connection within 5 s; an answer may come before that.
inline bool is_closed_by_host(int fd) {
    char answer[4096];
    ssize_t n = 0;
    do n = recv(fd, answer, sizeof answer, 0);
    while (n > 0);
    return n == 0 || errno == ECONNRESET;
}

/// Returns the first message type that the host sends; -1: it closes the connection without one.
inline int next_message_type(int fd) {
    unsigned char answer[12] = {};
    return recv(fd, answer, sizeof answer, MSG_WAITALL) == 12 ? answer[7] : -1;
}

inline bool gets_reply(int fd) { return next_message_type(fd) == 1; }

inline Bytes first_part(const Bytes& message, std::size_t size) {
    return {message.begin(), message.begin() + static_cast<std::ptrdiff_t>(size)};
}

inline Bytes last_part(const Bytes& message, std::size_t begin) {
    return {message.begin() + static_cast<std::ptrdiff_t>(begin), message.end()};
}

/// The request of a call of the manager that has texts only. Unlike call(), it needs no ORB in the test.
inline Bytes request_with_texts(const std::string& operation, std::initializer_list<std::string> texts) {
    MessageWriter m(true, 2, 0);
    const std::size_t begin = m.bytes.size();
    for (const auto& text : texts) m.text(text, true);
    return request("manager", operation, last_part(m.bytes, begin), 2, true);
}

/// A call that takes `ms`, with a request of about `size` bytes.
inline Bytes slow_call(const std::string& name, int ms, std::size_t size) {
    return request_with_texts("create_component", {"SlowDevice?instance_name=" + name + "&in=initialize&ms=" +
                                                   std::to_string(ms) + "&text=" + std::string(size, 'x')});
}

/// Returns whether the host has read all that the test has sent by this connection, from proc(5).
inline bool has_read_all(int fd, const std::string& port) {
    sockaddr_in own{};
    socklen_t size = sizeof own;
    getsockname(fd, reinterpret_cast<sockaddr*>(&own), &size);
    const auto end_of = [](unsigned number) {
        char text[16];
        std::snprintf(text, sizeof text, "0100007F:%04X", number);
        return std::string(text);
    };
    const std::string host_end = end_of(static_cast<unsigned>(std::stoi(port))),
                      test_end = end_of(ntohs(own.sin_port));
    std::ifstream table("/proc/net/tcp");
    bool is_sent = false, is_read = false;
    for (std::string line; std::getline(table, line);) {
        std::istringstream words(line);
        std::string number, local, remote, state, queues; // queues: to send and to read
        words >> number >> local >> remote >> state >> queues;
        if (local == test_end && remote == host_end) is_sent = queues.starts_with("00000000:");
        if (local == host_end && remote == test_end) is_read = queues.ends_with(":00000000");
    }
    return is_sent && is_read;
}

} // namespace testing
