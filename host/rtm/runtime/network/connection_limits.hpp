// SPDX-License-Identifier: Apache-2.0
// Bounds what the peers of this process can occupy by CORBA: connections, and the time that they need for a request.
#pragma once
#include <chrono>
#include <coil/Properties.h>
#include <cstddef>
#include <string>
#include <vector>

namespace omni {
class giopStrand;
}

namespace RTC {

/// Limits from rtc.conf.
struct ConnectionLimits {
    std::size_t connections = 512; ///< that peers have opened; one machine has at most half of them
    std::chrono::milliseconds request{20000}; ///< from the header of a request to its last byte
};

/// Reads corba.max_connections and corba.request_timeout. Throws std::runtime_error, one line, for an invalid value.
ConnectionLimits read_connection_limits(const coil::Properties& config);

/// Sets the limits of this process. Call it before ORB_init().
void set_connection_limits(const ConnectionLimits& limits);
const ConnectionLimits& connection_limits();

/// Threads for the first connections, one for each, and for the others together.
inline constexpr int separate_threads = 15, shared_threads = 32;

/// Returns omniORB's options that bound the threads of connections.
std::vector<std::string> thread_limit_options();

/// Makes omniORB close the connections that have given way before they got a thread. Call it after ORB_init(), before
/// the other functions that add interceptors of accepted connections.
void refuse_excess_connections();

/// Makes room for a connection that omniORB has just accepted: closes one that has never sent a request, or else the one
/// that has been idle for longest. Returns false, and the caller closes the new one, if none is idle, or if many still
/// wait for a thread that closes them. Called with omniORB's transport lock held. [ORB thread]
bool admit_connection(omni::giopStrand& connection);

/// Notes that the connection has just been in use, by the thread that serves it. [ORB thread]
void note_use(omni::giopStrand& connection);

/// Notes that omniORB gives back the socket of an accepted connection. Returns false if it has done so before. Called with
/// omniORB's transport lock held. [ORB thread]
bool note_release(omni::giopStrand& connection);

/// Ends the idle time of a connection before its request has been read. [ORB thread]
void keep_from_closing(omni::giopStrand& connection);

/// Returns whether admit_connection() has closed this connection in favour of a newer one.
bool was_closed_for_another(const omni::giopStrand& connection);

/// Logs that this process closes the connection, but not each time. Names its peer. [ORB thread]
void log_closed_connection(omni::giopStrand& connection, const std::string& reason);
void log_excess_connection(omni::giopStrand& connection);

} // namespace RTC
