// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/peer.hpp"

#include "host/process/socket_owner.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::monitor {
namespace {

namespace ip = boost::asio::ip;

/// A machine has at least a network of 64 bits, so that its single addresses cost it nothing.
std::string network_of(const ip::address& address) {
    if (address.is_v4()) return address.to_string();
    auto bytes = address.to_v6().to_bytes();
    std::fill(bytes.begin() + 8, bytes.end(), static_cast<unsigned char>(0));
    return ip::address_v6(bytes).to_string() + "/64";
}

} // namespace

ip::address plain_address(const ip::address& address) {
    if (address.is_v4()) return address;
    const ip::address_v6 v6 = address.to_v6();
    if (v6.is_v4_mapped()) return ip::make_address_v4(ip::v4_mapped, v6);
    return ip::address_v6(v6.to_bytes());
}

Peer find_peer(const ip::tcp::socket& socket) {
    boost::system::error_code failure;
    const auto theirs = socket.remote_endpoint(failure);
    const auto ours = failure ? ip::tcp::endpoint() : socket.local_endpoint(failure);
    if (failure) return {"gone", false, std::nullopt, ""};
    const ip::address address = plain_address(theirs.address());
    const auto user = process::find_socket_owner(process::make_tcp_end(*theirs.data()),
                                                 process::make_tcp_end(*ours.data()));
    const bool is_local = user || address.is_loopback() || address == plain_address(ours.address());
    const std::string number = address.to_string();
    const std::string at = fmt::format("{}:{}", address.is_v6() ? "[" + number + "]" : number, theirs.port());
    if (!is_local) return {network_of(address), false, std::nullopt, at};
    return {user ? fmt::format("user {}", *user) : "an unknown user", true, user, at};
}

std::string describe(const Peer& peer) {
    if (peer.address.empty()) return "a client that has left";
    return (peer.is_local ? process::describe_user(peer.user) : "another machine") + " at " + peer.address;
}

} // namespace tandem::monitor
