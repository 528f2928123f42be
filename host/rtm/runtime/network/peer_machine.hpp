// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/RTC.h>
#include <string>

namespace RTC {

/// The parts of an address as omniORB writes it: `giop:tcp:127.0.0.1:4711`, `giop:ssl:[::1]:4711`, `giop:unix:/run/x`.
struct GiopAddress {
    std::string
        host; ///< without brackets; an address of IPv4 within one of IPv6 is one of IPv4; empty: a Unix socket
    std::string port;   ///< of TCP
    std::string socket; ///< path of a Unix socket
};
GiopAddress parse_giop_address(const std::string& text);

/// Returns whether the address, as omniORB writes it (`giop:tcp:127.0.0.1:4711`), belongs to this machine. A Unix
/// socket does if it exists here. Host names are resolved, within the time limits of the resolver. [any-thread]
bool is_address_of_this_machine(const std::string& giop_address);

/// Returns the address of the object's process, `giop:tcp:HOST:PORT`, if none of the addresses in its reference belongs
/// to this machine. Otherwise, or without an address, returns an empty string. Host names are resolved, within the
/// resolver's own time limits. [any-thread]
std::string address_on_another_machine(CORBA::Object_ptr object);

} // namespace RTC
