// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/network/connection_limits.hpp"

#include "host/process/log_throttle.hpp"
#include "host/rtm/runtime/network/access.hpp"
#include "host/rtm/runtime/network/connection_socket.hpp"

#include <array>
#include <bit>
#include <coil/stringutil.h>
#include <omniORB4/CORBA.h>
#include <omniORB4/internal/giopStrand.h>
#include <omniORB4/omniInterceptors.h>
#include <rtm/SystemLogger.h>
#include <stdexcept>
#include <string_view>
#include <sys/socket.h>

namespace RTC {
namespace {

constexpr CORBA::Long closed_for_another = -2; // omniORB counts its idle time down to 0; -1: it serves a call

// Never destroyed: threads of the ORB may outlive static objects.
struct State {
    ConnectionLimits limits;
    tandem::process::LogThrottle excess, closed;
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
    std::size_t all = 0, of_machine = 0;
    omni::giopStrand* least_used = nullptr;            ///< NULL: all of them serve a call
    omni::giopStrand* least_used_of_machine = nullptr; ///< likewise
};

bool is_used_less(const omni::giopStrand& one, const omni::giopStrand* other) {
    if (other == nullptr) return true;
    const bool was_checked = one.gatekeeper_checked, other_was_checked = other->gatekeeper_checked;
    if (was_checked != other_was_checked) return !was_checked; // has never sent anything
    return one.idlebeats < other->idlebeats;
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
    return census;
}

// A client to which the server has said so sends its next call by a new connection.
void send_close_connection(omni::giopStrand& connection) {
    constexpr char close_connection = 5, this_order = std::endian::native == std::endian::little ? 1 : 0;
    std::array<char, 12> message{'G',
                                 'I',
                                 'O',
                                 'P',
                                 static_cast<char>(connection.version.major),
                                 static_cast<char>(connection.version.minor),
                                 this_order,
                                 close_connection};
    omni_time_t deadline;
    omni_thread::get_time(deadline, omni_time_t(0, 10'000'000));
    connection.connection->Send(message.data(), message.size(), deadline);
}

// Ends the input only. The thread that sees this end closes the connection. Until then the kernel knows the user at the
// other end, whom the log names.
void end_input(omni::giopStrand& connection) {
    connection.state(omni::giopStrand::DYING);
    if (::shutdown(socket_of(*connection.connection), SHUT_RD) != 0) connection.connection->Shutdown();
}

void close_for_another(omni::giopStrand& connection) {
    connection.StrandList::remove();
    connection.idlebeats = closed_for_another;
    if (connection.gatekeeper_checked) send_close_connection(connection);
    end_input(connection);
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
        // A connection has a thread of its own, as long as there are few. The others share threads.
        "-ORBthreadPerConnectionUpperLimit", "32", "-ORBthreadPerConnectionLowerLimit", "24",
        "-ORBmaxServerThreadPoolSize", std::to_string(shared_threads),
        // omniORB 4.2 uses freed memory when it serves broken requests of one connection simultaneously.
        "-ORBmaxServerThreadPerConnection", "1",
        // A day, in s: the connection of an idle tool is kept until others need the room. omniORB then knows how long
        // each has been idle.
        "-ORBinConScanPeriod", "86400"};
}

void refuse_excess_connections() { omniORB::getInterceptors()->serverAcceptConnection.add(refuse_excess); }

bool admit_connection(omni::giopStrand& connection) {
    const Census census = count_connections(machine_of(connection));
    const std::size_t most = connection_limits().connections;
    omni::giopStrand* victim = nullptr;
    if (census.of_machine >= (most + 1) / 2)
        victim = census.least_used_of_machine;
    else if (census.all >= most)
        victim = census.least_used;
    else
        return true;
    if (victim != nullptr) {
        close_for_another(*victim);
        return true;
    }
    end_input(connection);
    return false;
}

bool was_closed_for_another(const omni::giopStrand& connection) {
    return connection.idlebeats == closed_for_another;
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
    auto& throttle = state().excess;
    if (!throttle.should_log()) return;
    const std::size_t most = connection_limits().connections;
    Logger rtclog("access");
    RTC_WARN(
        ("closed a connection (%llu so far) of %s: %zu connections of one machine or %zu in all were open; "
         "corba.max_connections of rtc.conf sets the limit",
         static_cast<unsigned long long>(throttle.count()), describe_peer(connection).c_str(), (most + 1) / 2,
         most));
}

} // namespace RTC
