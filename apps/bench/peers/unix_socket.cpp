// SPDX-License-Identifier: Apache-2.0
// Unix sockets: SOCK_SEQPACKET for messages, SOCK_STREAM for what is longer than a packet may be.
#include "apps/bench/harness/cases.hpp"
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

[[noreturn]] void fail(const char* operation) {
    throw std::system_error(errno, std::generic_category(), operation);
}

/// Abstract name: no file that could be left behind.
socklen_t address_of(const std::string& name, sockaddr_un& address) {
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path + 1, name.data(), name.size());
    return static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
}

int connected(const Session& session, int type) {
    sockaddr_un address{};
    const socklen_t size = address_of(session.name(), address);
    const int fd = socket(AF_UNIX, type | SOCK_CLOEXEC, 0);
    if (fd < 0) fail("socket");
    if (session.is_a()) {
        while (connect(fd, reinterpret_cast<const sockaddr*>(&address), size) != 0) {
            if (errno != ECONNREFUSED) fail("connect");
            std::this_thread::sleep_for(std::chrono::milliseconds(1)); // B is not there yet
        }
        return fd;
    }
    if (bind(fd, reinterpret_cast<const sockaddr*>(&address), size) != 0 || listen(fd, 1) != 0) fail("bind");
    const int peer = accept4(fd, nullptr, nullptr, SOCK_CLOEXEC);
    close(fd);
    if (peer < 0) fail("accept");
    return peer;
}

template <std::size_t bytes, Wake wake, int type>
class SocketEndpoint {
  public:
    explicit SocketEndpoint(Session& session) : fd_(connected(session, type)) {}
    ~SocketEndpoint() { close(fd_); }
    SocketEndpoint(const SocketEndpoint&) = delete;
    SocketEndpoint& operator=(const SocketEndpoint&) = delete;
    void send(std::uint64_t sequence) {
        message_.write(sequence);
        const auto* data = static_cast<const std::byte*>(message_.data());
        for (std::size_t done = 0; done < bytes;) {
            const ssize_t sent = ::send(fd_, data + done, bytes - done, MSG_NOSIGNAL);
            if (sent < 0) fail("send");
            done += static_cast<std::size_t>(sent);
        }
    }
    std::uint64_t receive() {
        constexpr int flags = type == SOCK_STREAM ? MSG_WAITALL : wake == Wake::spin ? MSG_DONTWAIT : 0;
        for (;;) {
            const ssize_t got = recv(fd_, message_.data(), bytes, flags);
            if (got == static_cast<ssize_t>(bytes)) return message_.read();
            if (got >= 0) throw std::runtime_error("recv: the other side has closed its socket");
            if (errno != EAGAIN) fail("recv");
        }
    }

  private:
    Message<bytes> message_;
    int fd_;
};

template <Wake wake>
using PacketEndpoint = SocketEndpoint<64, wake, SOCK_SEQPACKET>;
template <std::size_t bytes>
using StreamEndpoint = SocketEndpoint<bytes, Wake::blocking, SOCK_STREAM>;

} // namespace

void add_socket_cases(Registry& registry) {
    PeerCases cases(registry, "unix-socket");
    cases.one_way<PacketEndpoint<Wake::spin>>(Wake::spin);
    cases.one_way<PacketEndpoint<Wake::blocking>>(Wake::blocking);
    cases.call<PairClientOf<PacketEndpoint<Wake::spin>>, PairServerOf<PacketEndpoint<Wake::spin>>>(Wake::spin,
                                                                                                   "pair");
    cases.rate<PacketEndpoint<Wake::blocking>>(Wake::blocking);
    cases.large<StreamEndpoint<mebibyte>>(mebibyte, Wake::blocking, "copy");
    cases.large<StreamEndpoint<6 * mebibyte>>(6 * mebibyte, Wake::blocking, "copy");
}

} // namespace tandem::bench
