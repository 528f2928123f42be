// SPDX-License-Identifier: Apache-2.0
// CORBA of OpenRTM-aist has no authentication. The operating system knows the user of a connection from this machine,
// but nobody knows the user of a connection from another machine: only its address, or that it has a certificate.
#include "host/rtm/runtime/network/access.hpp"

#include "host/process/log_throttle.hpp"
#include "host/process/socket_owner.hpp"
#include "host/rtm/runtime/network/host_ranges.hpp"
#include "host/rtm/runtime/network/peer_machine.hpp"
#include "host/rtm/runtime/network/tls.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <coil/stringutil.h>
#include <memory>
#include <netdb.h>
#include <omniORB4/CORBA.h>
#include <omniORB4/internal/giopStrand.h>
#include <omniORB4/omniInterceptors.h>
#include <omniORB4/unixConnection.h>
#include <optional>
#include <pwd.h>
#include <rtm/SystemLogger.h>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <sys/types.h>
#include <unistd.h>

namespace RTC {
namespace {

using tandem::process::describe_user;

/// The peer of a CORBA connection that this process has accepted.
struct ConnectionPeer {
    bool is_on_this_machine;
    std::optional<uid_t> user; ///< on this machine; empty if the kernel does not say
    std::string host;          ///< of another machine: its address
    std::string address;       ///< as omniORB writes it; empty: a Unix socket
};

// For messages: `user alice (1001) at 127.0.0.1:4711`. Asks the user database, which may be slow.
std::string describe(const ConnectionPeer& peer) {
    if (!peer.is_on_this_machine) return "another machine at " + peer.address;
    return describe_user(peer.user) + " at " + (peer.address.empty() ? "the Unix socket" : peer.address);
}

tandem::process::TcpEnd parse_end(const std::string& giop_address) {
    const GiopAddress text = parse_giop_address(giop_address);
    addrinfo hints{}, *list = nullptr;
    hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
    hints.ai_socktype = SOCK_STREAM; // one result, which getaddrinfo() does not ask the kernel to sort
    if (::getaddrinfo(text.host.c_str(), text.port.c_str(), &hints, &list) != 0) return {};
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owned(list, ::freeaddrinfo);
    return tandem::process::make_tcp_end(*list->ai_addr);
}

ConnectionPeer peer_of_unix_socket(int fd) {
    ucred credentials{};
    socklen_t size = sizeof credentials;
    std::optional<uid_t> user;
    if (::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &credentials, &size) == 0) user = credentials.uid;
    return {true, user, "", ""};
}

/// Identifies the peer: by the credentials of a Unix socket or, for a TCP connection within this machine, by the owner
/// of the socket at the other end. [ORB thread]
ConnectionPeer find_connection_peer(omni::omniInterceptors::serverAcceptConnection_T::info_T& connection) {
    if (const auto* local = dynamic_cast<omni::unixConnection*>(connection.strand.connection))
        return peer_of_unix_socket(local->handle());
    const std::string address = connection.peeraddress();
    const auto user =
        tandem::process::find_socket_owner(parse_end(address), parse_end(connection.myaddress()));
    if (!user && !is_address_of_this_machine(address))
        return {false, std::nullopt, parse_giop_address(address).host, address};
    return {true, user, "", address};
}

struct Access {
    std::set<uid_t> users;
    HostRanges hosts;
    bool remote_load = false, remote_shutdown = false;
    tandem::process::LogThrottle refused_connections, refused_calls;
};

// Never destroyed: threads of the ORB may outlive static objects.
Access& access() {
    static auto& the_access = *new Access;
    return the_access;
}

// Why the request that this thread serves is refused; empty if it is not refused.
thread_local std::string refusal;

constexpr std::array<std::string_view, 3> loading{"load_module", "unload_module", "set_configuration"};
constexpr std::array<std::string_view, 4> ending{"shutdown", "restart", "exit", "delete_component"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

uid_t parse_user(const std::string& text) {
    uid_t number = 0;
    const char* const end = text.data() + text.size();
    if (const auto [rest, error] = std::from_chars(text.data(), end, number);
        error == std::errc() && rest == end)
        return number;
    std::array<char, 4096> buffer{};
    passwd entry{}, *found = nullptr;
    if (::getpwnam_r(text.c_str(), &entry, buffer.data(), buffer.size(), &found) == 0 && found != nullptr)
        return entry.pw_uid;
    throw std::runtime_error("corba.permitted_users: this machine has no user " + text +
                             "; expected names or numbers of users");
}

// A client without a certificate does not get beyond the handshake of TLS.
bool may_connect(const ConnectionPeer& peer) {
    if (peer.is_on_this_machine) return peer.user && access().users.count(*peer.user) != 0;
    const HostRanges& hosts = access().hosts;
    return hosts.empty() ? uses_tls() : hosts.contains(peer.host);
}

// [ORB thread]
CORBA::Boolean refuse_strangers(omni::omniInterceptors::serverAcceptConnection_T::info_T& connection) {
    const ConnectionPeer peer = find_connection_peer(connection);
    if (may_connect(peer)) return true;
    connection.reject = true;
    connection.why = peer.is_on_this_machine ? "another user of this machine" : "another machine";
    if (auto& throttle = access().refused_connections; throttle.should_log()) {
        Logger rtclog("access");
        RTC_WARN(
            ("refused a connection (%llu so far): it comes from %s; %s of rtc.conf names %s who may connect",
             static_cast<unsigned long long>(throttle.count()), describe(peer).c_str(),
             peer.is_on_this_machine ? "corba.permitted_users" : "corba.permitted_hosts",
             peer.is_on_this_machine ? "users" : "machines"));
    }
    return true;
}

// [ORB thread]
CORBA::Boolean note_remote_request(omni::omniInterceptors::serverReceiveRequest_T::info_T& request) {
    refusal.clear();
    const std::string_view operation = request.operation();
    const bool loads = contains(loading, operation), ends = contains(ending, operation);
    if ((!loads || access().remote_load) && (!ends || access().remote_shutdown)) return true;
    const std::string peer = request.peeraddress();
    const bool is_unix_socket = !parse_giop_address(peer).socket.empty();
    if (is_unix_socket || is_address_of_this_machine(peer)) return true; // its user has already been checked
    refusal = std::string(operation) + " by another machine, " + peer +
              ": only processes of this user may; " +
              (loads ? "manager.modules.remote_load" : "manager.remote_shutdown") +
              ": YES in rtc.conf permits it to every client that can connect";
    return true;
}

} // namespace

AccessRules read_access_rules(const coil::Properties& config) {
    auto yes = [&](const char* key) { return coil::toBool(config.getProperty(key), "YES", "NO", false); };
    return {coil::split(config.getProperty("corba.permitted_users"), ",", true),
            coil::split(config.getProperty("corba.permitted_hosts"), ",", true),
            yes("manager.modules.remote_load"), yes("manager.remote_shutdown")};
}

void control_access(const AccessRules& rules) {
    Access& all = access();
    all.users = {::geteuid(), 0}; // root can do everything anyway
    for (const auto& user : rules.users) all.users.insert(parse_user(user));
    try {
        all.hosts = HostRanges(rules.hosts);
    } catch (const std::invalid_argument& e) {
        throw std::runtime_error(std::string("corba.permitted_hosts: ") + e.what());
    }
    all.remote_load = rules.remote_load;
    all.remote_shutdown = rules.remote_shutdown;
    omni::omniInterceptors* interceptors = omniORB::getInterceptors();
    interceptors->serverAcceptConnection.add(refuse_strangers);
    interceptors->serverReceiveRequest.add(note_remote_request);
}

void require_permission() {
    if (refusal.empty()) return;
    if (access().refused_calls.should_log()) {
        Logger rtclog("access");
        RTC_WARN(("refused %s", refusal.c_str()));
    }
    throw CORBA::NO_PERMISSION(0, CORBA::COMPLETED_NO);
}

std::string describe_peer(omni::giopStrand& connection) {
    omni::omniInterceptors::serverAcceptConnection_T::info_T info(connection);
    return describe(find_connection_peer(info));
}

} // namespace RTC
