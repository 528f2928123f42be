// SPDX-License-Identifier: Apache-2.0
#pragma once
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

} // namespace RTC
