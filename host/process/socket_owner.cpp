// SPDX-License-Identifier: Apache-2.0
#include "host/process/socket_owner.hpp"

#include "host/process/file_descriptor.hpp"

#include <cstring>
#include <linux/inet_diag.h>
#include <linux/netlink.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <pwd.h>
#include <sys/time.h>

namespace tandem::process {
namespace {

struct Request {
    nlmsghdr header;
    inet_diag_req_v2 body;
};

Request make_request(const TcpEnd& theirs, const TcpEnd& ours) {
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
    return request;
}

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

} // namespace

TcpEnd make_tcp_end(const sockaddr& address) {
    TcpEnd end;
    if (address.sa_family == AF_INET) {
        const auto& v4 = reinterpret_cast<const sockaddr_in&>(address);
        end = {AF_INET, {v4.sin_addr.s_addr}, v4.sin_port};
    } else if (address.sa_family == AF_INET6) {
        const auto& v6 = reinterpret_cast<const sockaddr_in6&>(address);
        end.family = AF_INET6;
        end.port = v6.sin6_port;
        std::memcpy(end.address.data(), &v6.sin6_addr, sizeof end.address);
        if (IN6_IS_ADDR_V4MAPPED(&v6.sin6_addr)) end = {AF_INET, {end.address[3]}, end.port};
    }
    return end;
}

std::optional<uid_t> find_socket_owner(const TcpEnd& theirs, const TcpEnd& ours) {
    const Request request = make_request(theirs, ours);
    const FileDescriptor kernel(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_SOCK_DIAG));
    if (kernel.get() < 0) return std::nullopt;
    const timeval longest{1, 0};
    ::setsockopt(kernel.get(), SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
    if (::send(kernel.get(), &request, sizeof request, 0) != static_cast<ssize_t>(sizeof request))
        return std::nullopt;
    std::array<char, 4096> reply{};
    const ssize_t size = ::recv(kernel.get(), reply.data(), reply.size(), 0);
    return size < 0 ? std::nullopt : owner_in(reply.data(), static_cast<std::size_t>(size));
}

std::string describe_user(std::optional<uid_t> user) {
    if (!user) return "an unknown user";
    std::array<char, 4096> buffer{};
    passwd entry{}, *found = nullptr;
    const bool has_name = ::getpwuid_r(*user, &entry, buffer.data(), buffer.size(), &found) == 0 && found;
    return "user " + (has_name ? std::string(entry.pw_name) + " (" + std::to_string(*user) + ")"
                               : std::to_string(*user));
}

} // namespace tandem::process
