// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/network/network_sockets.hpp"
#include "host/rtm/runtime/network/connection_socket.hpp"
#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <mutex>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <omniORB4/CORBA.h>
#include <omniORB4/internal/giopStrand.h>
#include <omniORB4/internal/giopStream.h>
#include <omniORB4/omniInterceptors.h>
#include <pthread.h>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <system_error>
#include <unistd.h>

#include <omniORB4/internal/GIOP_C.h> // needs the others before it

namespace RTC {
namespace {

/// One end of a TCP connection. IPv4 addresses are stored as IPv6, ::ffff:a.b.c.d, as in sockets that accept both.
struct SocketEnd {
    std::array<unsigned char, 16> address{};
    int port = -1; // not of IP
};

SocketEnd end_of(const sockaddr_storage& from) {
    SocketEnd end;
    if (from.ss_family == AF_INET) {
        const auto& v4 = reinterpret_cast<const sockaddr_in&>(from);
        end.address[10] = end.address[11] = 0xff;
        std::memcpy(&end.address[12], &v4.sin_addr, 4);
        end.port = ntohs(v4.sin_port);
    } else if (from.ss_family == AF_INET6) {
        const auto& v6 = reinterpret_cast<const sockaddr_in6&>(from);
        std::memcpy(end.address.data(), &v6.sin6_addr, 16);
        end.port = ntohs(v6.sin6_port);
    }
    return end;
}

template <class Use>
void for_each_descriptor(Use use) {
    std::error_code none;
    const std::filesystem::directory_iterator end;
    for (std::filesystem::directory_iterator it("/proc/self/fd", none); !none && it != end;
         it.increment(none))
        use(std::atoi(it->path().filename().c_str()));
}

/// Returns the place at which this end of a stream socket is reached: `:PORT`, or the path of a Unix socket. Empty for
/// any other descriptor.
std::string own_place(int fd) {
    int type = 0;
    socklen_t size = sizeof type;
    if (::getsockopt(fd, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_STREAM) return "";
    sockaddr_storage here{};
    size = sizeof here;
    if (::getsockname(fd, reinterpret_cast<sockaddr*>(&here), &size) != 0) return "";
    if (here.ss_family == AF_UNIX) return reinterpret_cast<const sockaddr_un&>(here).sun_path;
    const int port = end_of(here).port;
    return port > 0 ? ":" + std::to_string(port) : "";
}

std::vector<std::string> places_listened_at() {
    std::vector<std::string> places;
    for_each_descriptor([&](int fd) {
        int listens = 0;
        socklen_t size = sizeof listens;
        if (::getsockopt(fd, SOL_SOCKET, SO_ACCEPTCONN, &listens, &size) == 0 && listens != 0 &&
            !own_place(fd).empty())
            places.push_back(own_place(fd));
    });
    return places;
}

bool is_among(const std::vector<std::string>& places, const std::string& place) {
    return std::find(places.begin(), places.end(), place) != places.end();
}

// The places of the ORB, for the child of a fork(). Never destroyed: a process may fork() while static objects are
// being destroyed.
std::mutex places_mutex;
std::vector<std::string>& orb_places() {
    static auto& places = *new std::vector<std::string>;
    return places;
}

// The place of an accepted connection is the place at which it was accepted. The descriptor numbers stay in use: if
// another file got such a number, the child's copy of the ORB would close it or shut it down.
void replace_orb_sockets() {
    const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for_each_descriptor([&](int fd) {
        if (is_among(orb_places(), own_place(fd))) ::dup3(nowhere, fd, O_CLOEXEC);
    });
    ::close(nowhere);
    places_mutex.unlock();
}

// Whether the socket is connected to another machine. A Unix socket is not.
bool is_connected_to_network(int fd) {
    sockaddr_storage here{}, there{};
    socklen_t size = sizeof here, peer_size = sizeof there;
    if (::getpeername(fd, reinterpret_cast<sockaddr*>(&there), &peer_size) != 0 ||
        ::getsockname(fd, reinterpret_cast<sockaddr*>(&here), &size) != 0)
        return false;
    const SocketEnd own = end_of(here), other = end_of(there);
    return own.port > 0 && own.address != other.address;
}

void set_int(int fd, int level, int option, int value) {
    ::setsockopt(fd, level, option, &value,
                 sizeof value); // a socket without this option works too, but less well
}

// Without keep-alives, the thread that serves a connection waits forever for a machine that was switched off. If the
// other kernel does not acknowledge data for `max_silence` milliseconds, the connection ends. For clients this time is
// short, so that they soon make a new connection.
void send_keep_alives(int fd, int max_silence) {
    set_int(fd, SOL_SOCKET, SO_KEEPALIVE, 1);
    set_int(fd, IPPROTO_TCP, TCP_KEEPIDLE, 10); // s
    set_int(fd, IPPROTO_TCP, TCP_KEEPINTVL, 5); // s
    set_int(fd, IPPROTO_TCP, TCP_KEEPCNT, 4);
    set_int(fd, IPPROTO_TCP, TCP_USER_TIMEOUT, max_silence);
}

// When a call was not answered in time, omniORB closes its connection. Without these options, the kernel would continue
// to send the data of that connection once the network is back, in parallel with the next call's connection.
CORBA::Boolean on_client_connection(omni::omniInterceptors::clientOpenConnection_T::info_T& info) {
    const int fd = socket_of(*info.giop_c.strand().connection);
    if (!is_connected_to_network(fd)) return true;
    const linger drop_unsent{1, 0};
    ::setsockopt(fd, SOL_SOCKET, SO_LINGER, &drop_unsent, sizeof drop_unsent);
    send_keep_alives(fd, 2000);
    return true;
}

CORBA::Boolean on_server_connection(omni::omniInterceptors::serverAcceptConnection_T::info_T& info) {
    const int fd = socket_of(*info.strand.connection);
    if (is_connected_to_network(fd)) send_keep_alives(fd, 30'000);
    return true;
}

} // namespace

void set_up_network_sockets() {
    omni::omniInterceptors* interceptors = omniORB::getInterceptors();
    interceptors->clientOpenConnection.add(on_client_connection);
    interceptors->serverAcceptConnection.add(on_server_connection);
}

OrbSocketsAtFork::OrbSocketsAtFork() : places_before_(places_listened_at()) {}

void OrbSocketsAtFork::set_up() {
    static const int failure =
        ::pthread_atfork([] { places_mutex.lock(); }, [] { places_mutex.unlock(); }, replace_orb_sockets);
    if (failure != 0) throw std::system_error(failure, std::generic_category(), "fork() cannot be watched");
    const std::lock_guard<std::mutex> lock(places_mutex);
    orb_places().clear();
    for (const auto& place : places_listened_at())
        if (!is_among(places_before_, place)) orb_places().push_back(place);
}

} // namespace RTC
