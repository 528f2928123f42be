// SPDX-License-Identifier: Apache-2.0
// Only the reference shows where a peer runs, because processes of OpenRTM-aist set no property of Tandem.
#include "host/rtm/runtime/network/peer_machine.hpp"

#include <algorithm>
#include <cstring>
#include <ifaddrs.h>
#include <memory>
#include <netdb.h>
#include <netinet/in.h>
#include <omniORB4/giopEndpoint.h>
#include <omniORB4/omniIOR.h>
#include <sys/socket.h>
#include <unistd.h>

namespace RTC {
namespace {

const in_addr& ipv4(const sockaddr& address) {
    return reinterpret_cast<const sockaddr_in&>(address).sin_addr;
}
const in6_addr& ipv6(const sockaddr& address) {
    return reinterpret_cast<const sockaddr_in6&>(address).sin6_addr;
}

bool is_loopback(const sockaddr& address) {
    if (address.sa_family == AF_INET) return ntohl(ipv4(address).s_addr) >> 24U == IN_LOOPBACKNET;
    return address.sa_family == AF_INET6 && IN6_IS_ADDR_LOOPBACK(&ipv6(address));
}

bool is_equal(const sockaddr& a, const sockaddr& b) {
    if (a.sa_family != b.sa_family) return false;
    if (a.sa_family == AF_INET) return ipv4(a).s_addr == ipv4(b).s_addr;
    return a.sa_family == AF_INET6 && std::memcmp(&ipv6(a), &ipv6(b), sizeof(in6_addr)) == 0;
}

// Returns whether a network interface of this machine has the address.
bool has_interface(const sockaddr& address) {
    ifaddrs* list = nullptr;
    if (::getifaddrs(&list) != 0) return true; // nothing is known, which is no reason to refuse
    const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> owned(list, ::freeifaddrs);
    for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next)
        if (entry->ifa_addr != nullptr && is_equal(*entry->ifa_addr, address)) return true;
    return false;
}

bool has_unix_socket(const omni::giopAddress* address) {
    return !parse_giop_address(address->address()).socket.empty();
}

bool is_host_of_this_machine(const std::string& host) {
    if (host == "localhost") return true; // RFC 6761; a minimal Debian has no /etc/hosts that says so
    addrinfo hints{}, *list = nullptr;
    hints.ai_socktype = SOCK_STREAM; // otherwise, each address appears once for each type of socket
    if (::getaddrinfo(host.c_str(), nullptr, &hints, &list) != 0) return false;
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owned(list, ::freeaddrinfo);
    for (const addrinfo* entry = list; entry != nullptr; entry = entry->ai_next)
        if (is_loopback(*entry->ai_addr) || has_interface(*entry->ai_addr)) return true;
    return false;
}

} // namespace

GiopAddress parse_giop_address(const std::string& text) {
    const std::string unix_prefix = "giop:unix:", mapped_prefix = "::ffff:";
    if (text.compare(0, unix_prefix.size(), unix_prefix) == 0)
        return {"", "", text.substr(unix_prefix.size())};
    const std::size_t begin = text.find(':', text.find(':') + 1) + 1, colon = text.rfind(':');
    if (begin == 0 || colon < begin || colon == std::string::npos) return {};
    GiopAddress address{text.substr(begin, colon - begin), text.substr(colon + 1), ""};
    std::string& host = address.host;
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
    if (host.compare(0, mapped_prefix.size(), mapped_prefix) == 0) host.erase(0, mapped_prefix.size());
    return address;
}

bool is_address_of_this_machine(const std::string& giop_address) {
    const GiopAddress address = parse_giop_address(giop_address);
    if (!address.socket.empty()) return ::access(address.socket.c_str(), F_OK) == 0;
    return !address.host.empty() && is_host_of_this_machine(address.host);
}

std::string address_on_another_machine(CORBA::Object_ptr object) {
    if (CORBA::is_nil(object) || object->_PR_getobj() == nullptr) return "";
    const omniIOR_var ior = object->_PR_getobj()->_getIOR();
    const auto& addresses = ior->getIORInfo()->addresses();
    // A process that has only a Unix socket is on this machine, even if it has ended and removed the socket.
    const bool is_here = std::all_of(addresses.begin(), addresses.end(), has_unix_socket) ||
                         std::any_of(addresses.begin(), addresses.end(), [](auto* address) {
                             return is_address_of_this_machine(address->address());
                         });
    return is_here ? "" : addresses[0]->address();
}

} // namespace RTC
