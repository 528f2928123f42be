// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/network/connection_limits.hpp"

#include "host/process/log_throttle.hpp"
#include "host/rtm/runtime/network/access.hpp"
#include "host/rtm/runtime/network/connection_socket.hpp"

#include <array>
#include <atomic>
#include <bit>
#include <coil/stringutil.h>
#include <limits>
#include <omniORB4/CORBA.h>
#include <omniORB4/internal/giopStrand.h>
#include <omniORB4/omniInterceptors.h>
#include <rtm/SystemLogger.h>
#include <stdexcept>
#include <string_view>
#include <sys/socket.h>
#include <utility>

namespace RTC {

// Access to a private member: an explicit instantiation may name it. omniORB numbers its own calls with it, and so does
// not use it for a connection that it has accepted.
using NumberMember = CORBA::ULong omni::giopStrand::*;
struct LastUse {
    friend NumberMember member_of(LastUse);
};
template <class Name, NumberMember member>
struct OpenedNumber {
    friend NumberMember member_of(Name) { return member; }
};
template struct OpenedNumber<LastUse, &omni::giopStrand::seqNumber>;

namespace {

// omniORB counts the idle time of a connection down to `expired`, and then drops a request that arrives. Negative: the
// connection serves a call.
constexpr CORBA::Long expired = 0;

// The last use of a connection whose socket omniORB has given back.
constexpr CORBA::ULong released = std::numeric_limits<CORBA::ULong>::max();

// Connections that have given way to others, and wait for a thread that closes them. With more, new ones are refused.
constexpr std::size_t most_closing = 64;

// Never destroyed: threads of the ORB may outlive static objects.
struct State {
    ConnectionLimits limits;
    tandem::process::LogThrottle excess, closed;
    omni::StrandList
        closing; ///< connections that have given way, until they are deleted; by the transport lock
    std::atomic<CORBA::ULong> requests{0};
};
State& state() {
    static auto& the_state = *new State;
    return the_state;
}

double read_number(const coil::Properties& config, const char* key, double default_value, double least,
                   double most) {
    const std::string text = config.getProperty(key);
    if (text.empty()) return default_value;
    double value = 0;
    if (coil::stringTo(value, text.c_str()) && value >= least && value <= most) return value;
    throw std::runtime_error(std::string(key) + " is " + text + ", expected a number from " +
                             coil::otos(least) + " to " + coil::otos(most));
}

// All connections of one machine have this part of the address in common: `giop:tcp:10.0.0.5`, `giop:unix`.
std::string_view machine_of(const omni::giopStrand& connection) {
    const std::string_view address = connection.connection->peeraddress();
    return address.substr(0, address.rfind(':'));
}

/// The connections that omniORB has accepted.
struct Census {
    std::size_t all = 0, of_machine = 0, closing = 0;
    omni::giopStrand* least_used = nullptr;            ///< NULL: all of them serve a call
    omni::giopStrand* least_used_of_machine = nullptr; ///< NULL: those of the machine all serve a call
};

CORBA::ULong& last_use(omni::giopStrand& connection) { return connection.*member_of(LastUse{}); }

// In requests of all connections. One that has never sent a request is the oldest; of several, the first in the list.
CORBA::ULong age(omni::giopStrand& connection) {
    const CORBA::ULong last = last_use(connection);
    return last == 0 ? std::numeric_limits<CORBA::ULong>::max() : state().requests - last;
}

bool is_used_less(omni::giopStrand& one, omni::giopStrand* other) {
    return other == nullptr || age(one) > age(*other);
}

Census count_connections(std::string_view machine) {
    Census census;
    for (omni::StrandList* at = omni::giopStrand::passive.next; at != &omni::giopStrand::passive;
         at = at->next) {
        auto* const connection = static_cast<omni::giopStrand*>(at);
        const bool is_of_machine = machine_of(*connection) == machine;
        ++census.all;
        if (is_of_machine) ++census.of_machine;
        if (connection->idlebeats < 0) continue;
        if (is_used_less(*connection, census.least_used)) census.least_used = connection;
        if (is_of_machine && is_used_less(*connection, census.least_used_of_machine))
            census.least_used_of_machine = connection;
    }
    for (omni::StrandList* at = state().closing.next; at != &state().closing; at = at->next) ++census.closing;
    return census;
}

// A client to which the server has said so sends its next call by a new connection. OpenSSL permits no message while
// another thread reads, so a client by TLS learns it from the end of the connection.
void send_close_connection(omni::giopStrand& connection) {
    if (std::string_view(connection.connection->peeraddress()).starts_with("giop:ssl:")) return;
    constexpr char close_connection = 5, this_order = std::endian::native == std::endian::little ? 1 : 0;
    const std::array<char, 12> message{'G',
                                       'I',
                                       'O',
                                       'P',
                                       static_cast<char>(connection.version.major),
                                       static_cast<char>(connection.version.minor),
                                       this_order,
                                       close_connection};
    ::send(socket_of(*connection.connection), message.data(), message.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

// Ends the input only. The thread that sees this end closes the connection. Until then the kernel knows the user at the
// other end, whom the log names.
void end_input(omni::giopStrand& connection) {
    connection.state(omni::giopStrand::DYING);
    if (::shutdown(socket_of(*connection.connection), SHUT_RD) != 0) connection.connection->Shutdown();
}

void close_for_another(omni::giopStrand& connection) {
    connection.StrandList::remove();
    connection.StrandList::insert(state().closing);
    connection.idlebeats = expired;
    if (connection.gatekeeper_checked) send_close_connection(connection);
    end_input(connection);
}

void warn_of_excess(const std::string& peer) {
    const std::size_t most = connection_limits().connections;
    Logger rtclog("access");
    RTC_WARN(
        ("closed a connection (%llu so far) of %s: %zu connections of one machine or %zu in all were open; "
         "corba.max_connections of rtc.conf sets the limit",
         static_cast<unsigned long long>(state().excess.count()), peer.c_str(), (most + 1) / 2, most));
}

// [ORB thread]
CORBA::Boolean refuse_excess(omni::omniInterceptors::serverAcceptConnection_T::info_T& connection) {
    if (connection.strand.state() != omni::giopStrand::DYING) return true;
    connection.reject = true;
    connection.why = "there are too many connections";
    log_excess_connection(connection.strand);
    return false; // skips the other interceptors
}

} // namespace

ConnectionLimits read_connection_limits(const coil::Properties& config) {
    ConnectionLimits limits;
    limits.connections = static_cast<std::size_t>(
        read_number(config, "corba.max_connections", static_cast<double>(limits.connections), 2, 100'000));
    const double seconds = read_number(config, "corba.request_timeout",
                                       std::chrono::duration<double>(limits.request).count(), 0.1, 3600);
    limits.request = std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000));
    return limits;
}

void set_connection_limits(const ConnectionLimits& limits) { state().limits = limits; }
const ConnectionLimits& connection_limits() { return state().limits; }

std::vector<std::string> thread_limit_options() {
    return {
        // The first connections have one thread each, and the others share threads. There must be more shared threads
        // than others: until a new thread begins to serve its connection, omniORB counts it as a shared one. If a burst of
        // connections filled the pool with such threads, omniORB would queue requests without any shared thread that
        // could take them.
        // From the connection on that reaches the upper limit, omniORB makes no separate threads.
        "-ORBthreadPerConnectionUpperLimit", std::to_string(separate_threads + 1),
        "-ORBthreadPerConnectionLowerLimit", "12", "-ORBmaxServerThreadPoolSize",
        std::to_string(shared_threads),
        // omniORB 4.2 uses freed memory when it serves broken requests of one connection simultaneously.
        "-ORBmaxServerThreadPerConnection", "1",
        // A day, in s: the connection of an idle tool is kept until others need the room. omniORB then knows how long
        // each has been idle.
        "-ORBinConScanPeriod", "86400"};
}

void refuse_excess_connections() { omniORB::getInterceptors()->serverAcceptConnection.add(refuse_excess); }

bool admit_connection(omni::giopStrand& connection) {
    last_use(connection) = 0;
    const Census census = count_connections(machine_of(connection));
    const std::size_t most = connection_limits().connections;
    omni::giopStrand* victim = nullptr;
    if (census.of_machine >= (most + 1) / 2)
        victim = census.least_used_of_machine;
    else if (census.all >= most)
        victim = census.least_used;
    else
        return true;
    if (victim != nullptr && census.closing < most_closing) {
        close_for_another(*victim);
        return true;
    }
    // Without the user, since the lock must not wait for the kernel and the user database.
    if (state().excess.should_log()) warn_of_excess(connection.connection->peeraddress());
    return false;
}

void note_use(omni::giopStrand& connection) { last_use(connection) = ++state().requests; }

bool note_release(omni::giopStrand& connection) {
    return std::exchange(last_use(connection), released) != released;
}

void keep_from_closing(omni::giopStrand& connection) {
    const omni_tracedmutex_lock lock(*omni::omniTransportLock);
    connection.stopIdleCounter();
}

bool was_closed_for_another(const omni::giopStrand& connection) {
    const omni_tracedmutex_lock lock(*omni::omniTransportLock);
    const omni::StrandList* at = state().closing.next;
    while (at != &state().closing && at != &connection) at = at->next;
    return at == &connection;
}

void log_closed_connection(omni::giopStrand& connection, const std::string& reason) {
    auto& throttle = state().closed;
    if (!throttle.should_log()) return;
    Logger rtclog("access");
    RTC_WARN(("closed a connection (%llu so far) of %s: %s",
              static_cast<unsigned long long>(throttle.count()), describe_peer(connection).c_str(),
              reason.c_str()));
}

void log_excess_connection(omni::giopStrand& connection) {
    if (state().excess.should_log()) warn_of_excess(describe_peer(connection));
}

} // namespace RTC
