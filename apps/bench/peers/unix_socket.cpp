// SPDX-License-Identifier: Apache-2.0
// Unix sockets (unix(7)): SOCK_SEQPACKET for short messages, SOCK_STREAM for messages that are longer than a
// packet may be. A copy into the kernel and a copy out of it.
#include "apps/bench/peers/peer_cases.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <sys/socket.h>
#include <sys/un.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace tandem::bench {

namespace {

/// Throws an error with the text of errno.
[[noreturn]] void fail(const char* operation) {
    throw std::system_error(errno, std::generic_category(), operation);
}

/// An abstract name (it begins with a zero byte), so that no file can be left.
socklen_t address_of(const std::string& name, sockaddr_un& address) {
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path + 1, name.data(), name.size());
    return static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
}

/// Returns a connected socket: B listens and accepts, A connects. Throws std::system_error.
int connect_sides(const Session& session, int type) {
    sockaddr_un address{};
    const socklen_t size = address_of(session.name(), address);
    const int fd = socket(AF_UNIX, type | SOCK_CLOEXEC, 0);
    if (fd < 0) fail("socket");
    if (session.is_side_a()) {
        while (connect(fd, reinterpret_cast<const sockaddr*>(&address), size) != 0) {
            if (errno != ECONNREFUSED) fail("connect");
            std::this_thread::sleep_for(std::chrono::milliseconds(1)); // B does not listen yet
        }
        return fd;
    }
    if (bind(fd, reinterpret_cast<const sockaddr*>(&address), size) != 0 || listen(fd, 1) != 0) fail("bind");
    const int peer = accept4(fd, nullptr, nullptr, SOCK_CLOEXEC);
    close(fd);
    if (peer < 0) fail("accept");
    return peer;
}

/// One socket for both directions.
template <std::size_t bytes, Wake wake, int type>
class SocketEndpoint {
  public:
    explicit SocketEndpoint(Session& session) : fd_(connect_sides(session, type)) {}
    ~SocketEndpoint() { close(fd_); }
    SocketEndpoint(const SocketEndpoint&) = delete;
    SocketEndpoint& operator=(const SocketEndpoint&) = delete;
    void send(std::uint64_t sequence) {
        message_.fill(sequence);
        const auto* data = static_cast<const std::byte*>(message_.data());
        // A stream socket may take only a part; a packet is sent as a whole. MSG_NOSIGNAL: an error instead
        // of SIGPIPE.
        for (std::size_t done = 0; done < bytes;) {
            const ssize_t sent = ::send(fd_, data + done, bytes - done, MSG_NOSIGNAL);
            if (sent < 0) fail("send");
            done += static_cast<std::size_t>(sent);
        }
    }
    std::uint64_t receive() {
        // MSG_WAITALL: all bytes of a large message in one call.
        constexpr int flags = type == SOCK_STREAM ? MSG_WAITALL : wake == Wake::spin ? MSG_DONTWAIT : 0;
        for (;;) {
            const ssize_t got = recv(fd_, message_.data(), bytes, flags);
            if (got == static_cast<ssize_t>(bytes)) return message_.checked_sequence();
            if (got >= 0) throw std::runtime_error("recv: the other side has closed its socket");
            if (errno != EAGAIN) fail("recv");
        }
    }

  private:
    Message<bytes> message_;
    int fd_;
};

// Packets keep their boundaries and their order; streams have no limit of size.
template <Wake wake>
using PacketEndpoint = SocketEndpoint<64, wake, SOCK_SEQPACKET>;
template <std::size_t bytes>
using StreamEndpoint = SocketEndpoint<bytes, Wake::blocking, SOCK_STREAM>;

} // namespace

void add_unix_socket_cases(Registry& registry) {
    PeerCases cases(registry, "unix-socket");
    cases.add_one_way<PacketEndpoint<Wake::spin>>(Wake::spin);
    cases.add_one_way<PacketEndpoint<Wake::blocking>>(Wake::blocking);
    cases.add_call<PairClientOf<PacketEndpoint<Wake::spin>>, PairServerOf<PacketEndpoint<Wake::spin>>>(
        Wake::spin, "pair");
    cases.add_small_stream<PacketEndpoint<Wake::blocking>>(Wake::blocking);
    cases.add_large_stream<StreamEndpoint<mebibyte>>(mebibyte, Wake::blocking, "copy");
    cases.add_large_stream<StreamEndpoint<6 * mebibyte>>(6 * mebibyte, Wake::blocking, "copy");
}

} // namespace tandem::bench
