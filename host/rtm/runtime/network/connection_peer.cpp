// SPDX-License-Identifier: Apache-2.0
// sock_diag(7) names the owner of a TCP socket of this network namespace by the addresses of its two ends.
#include "host/rtm/runtime/network/connection_peer.hpp"
#include "host/rtm/runtime/network/giop_address.hpp"
#include "host/rtm/runtime/network/peer_machine.hpp"
#include <array>
#include <cstring>
#include <linux/inet_diag.h>
#include <linux/netlink.h>
#include <linux/sock_diag.h>
#include <memory>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <omniORB4/internal/giopStrand.h>
#include <omniORB4/unixConnection.h>
#include <pwd.h>
#include <sys/socket.h>
#include <unistd.h>

namespace RTC {
namespace {

/// One end of a TCP connection.
struct End {
    int family = AF_UNSPEC;
    std::array<std::uint32_t, 4> address{}; ///< in network order; of IPv4 the first one
    std::uint16_t port = 0;                 ///< in network order
};

End parse_end(const std::string& giop_address) {
    const GiopAddress text = parse_giop_address(giop_address);
    addrinfo hints{}, *list = nullptr;
    hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
    End end;
    if (::getaddrinfo(text.host.c_str(), text.port.c_str(), &hints, &list) != 0) return end;
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owned(list, ::freeaddrinfo);
    end.family = list->ai_family;
    if (end.family == AF_INET) {
        const auto& v4 = reinterpret_cast<const sockaddr_in&>(*list->ai_addr);
        end.address[0] = v4.sin_addr.s_addr;
        end.port = v4.sin_port;
    } else {
        const auto& v6 = reinterpret_cast<const sockaddr_in6&>(*list->ai_addr);
        std::memcpy(end.address.data(), &v6.sin6_addr, sizeof end.address);
        end.port = v6.sin6_port;
    }
    return end;
}

struct Request {
    nlmsghdr header;
    inet_diag_req_v2 body;
};

// A process that has closed its end no longer owns it: the kernel then shows user 0 and no inode.
std::optional<uid_t> owner_in(const char* reply, std::size_t size) {
    nlmsghdr header;
    inet_diag_msg message;
    if (size < NLMSG_HDRLEN + sizeof message) return std::nullopt;
    std::memcpy(&header, reply, sizeof header);
    if (header.nlmsg_type != SOCK_DIAG_BY_FAMILY) return std::nullopt;
    std::memcpy(&message, reply + NLMSG_HDRLEN, sizeof message);
    if (message.idiag_state != TCP_ESTABLISHED || message.idiag_inode == 0) return std::nullopt;
    return message.idiag_uid;
}

// Returns the owner of the socket that has connected from `theirs` to `ours`.
std::optional<uid_t> owner_of_socket(const End& theirs, const End& ours) {
    Request request{};
    request.header.nlmsg_len = sizeof request;
    request.header.nlmsg_type = SOCK_DIAG_BY_FAMILY;
    request.header.nlmsg_flags = NLM_F_REQUEST;
    request.body.sdiag_family = static_cast<std::uint8_t>(theirs.family);
    request.body.sdiag_protocol = IPPROTO_TCP;
    request.body.idiag_states = 1U << TCP_ESTABLISHED;
    request.body.id.idiag_sport = theirs.port;
    request.body.id.idiag_dport = ours.port;
    std::memcpy(request.body.id.idiag_src, theirs.address.data(), sizeof theirs.address);
    std::memcpy(request.body.id.idiag_dst, ours.address.data(), sizeof ours.address);
    request.body.id.idiag_cookie[0] = request.body.id.idiag_cookie[1] = INET_DIAG_NOCOOKIE;

    const int fd = ::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_SOCK_DIAG);
    if (fd < 0) return std::nullopt;
    const timeval longest{1, 0};
    ::setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
    std::array<char, 4096> reply{};
    ssize_t size = -1;
    if (::send(fd, &request, sizeof request, 0) == static_cast<ssize_t>(sizeof request))
        size = ::recv(fd, reply.data(), reply.size(), 0);
    ::close(fd);
    return size < 0 ? std::nullopt : owner_in(reply.data(), static_cast<std::size_t>(size));
}

std::string user_text(std::optional<uid_t> user) {
    if (!user) return "an unknown user";
    std::array<char, 4096> buffer{};
    passwd entry{}, *found = nullptr;
    const bool has_name = ::getpwuid_r(*user, &entry, buffer.data(), buffer.size(), &found) == 0 && found;
    return "user " + (has_name ? std::string(entry.pw_name) + " (" + std::to_string(*user) + ")"
                               : std::to_string(*user));
}

ConnectionPeer peer_of_unix_socket(int fd) {
    ucred credentials{};
    socklen_t size = sizeof credentials;
    std::optional<uid_t> user;
    if (::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &credentials, &size) == 0) user = credentials.uid;
    return {true, user, user_text(user) + " at the Unix socket"};
}

} // namespace

ConnectionPeer find_connection_peer(omni::omniInterceptors::serverAcceptConnection_T::info_T& connection) {
    if (const auto* local = dynamic_cast<omni::unixConnection*>(connection.strand.connection))
        return peer_of_unix_socket(local->handle());
    const std::string address = connection.peeraddress();
    const auto user = owner_of_socket(parse_end(address), parse_end(connection.myaddress()));
    if (!user && !is_address_of_this_machine(address))
        return {false, std::nullopt, "another machine at " + address};
    return {true, user, user_text(user) + " at " + address};
}

} // namespace RTC
