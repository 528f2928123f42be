// SPDX-License-Identifier: Apache-2.0
#include "host/process/file_descriptor.hpp"
#include "host/process/socket_owner.hpp"

#include <catch2/catch.hpp>
#include <netinet/in.h>
#include <unistd.h>

using namespace tandem::process;

namespace {

/// A TCP connection within this process.
struct OwnConnection {
    explicit OwnConnection(const in6_addr& address) {
        sockaddr_in6 place{};
        place.sin6_family = AF_INET6;
        place.sin6_addr = address;
        socklen_t size = sizeof place;
        auto* const generic = reinterpret_cast<sockaddr*>(&place);
        REQUIRE(::bind(listening.get(), generic, size) == 0);
        REQUIRE(::listen(listening.get(), 1) == 0);
        REQUIRE(::getsockname(listening.get(), generic, &size) == 0);
        REQUIRE(::connect(client.get(), generic, size) == 0);
        server = FileDescriptor(::accept4(listening.get(), nullptr, nullptr, SOCK_CLOEXEC));
        REQUIRE(server.get() >= 0);
        REQUIRE(::getpeername(server.get(), generic, &size) == 0);
        theirs = make_tcp_end(*generic);
        REQUIRE(::getsockname(server.get(), generic, &size) == 0);
        ours = make_tcp_end(*generic);
    }
    static FileDescriptor tcp_socket() {
        return FileDescriptor(::socket(AF_INET6, SOCK_STREAM | SOCK_CLOEXEC, 0));
    }

    FileDescriptor listening = tcp_socket(), client = tcp_socket(), server;
    TcpEnd theirs, ours;
};

in6_addr loopback_v4() {
    in6_addr address{};
    address.s6_addr[10] = address.s6_addr[11] = 0xff;
    address.s6_addr[12] = 127;
    address.s6_addr[15] = 1;
    return address;
}

} // namespace

TEST_CASE("the owner of a connected socket on this machine is found") {
    const OwnConnection connection(GENERATE(loopback_v4(), in6addr_loopback));
    CHECK(find_socket_owner(connection.theirs, connection.ours) == geteuid());
}

TEST_CASE("a socket that its process has closed has no owner") {
    OwnConnection connection(loopback_v4());
    connection.client = FileDescriptor();
    CHECK(find_socket_owner(connection.theirs, connection.ours) == std::nullopt);
}

TEST_CASE("an address of IPv4 within one of IPv6 is an address of IPv4") {
    const OwnConnection connection(loopback_v4());
    CHECK(connection.theirs.family == AF_INET);
    CHECK(connection.ours.address[0] == htonl(INADDR_LOOPBACK));
    const sockaddr other{AF_UNIX, {}};
    CHECK(make_tcp_end(other).family == AF_UNSPEC);
}

TEST_CASE("a user is described by name and number") {
    CHECK(describe_user(0) == "user root (0)");
    CHECK(describe_user(4'000'000'000U) == "user 4000000000");
    CHECK(describe_user(std::nullopt) == "an unknown user");
}
