// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <boost/asio/ip/network_v4.hpp>
#include <boost/asio/ip/network_v6.hpp>
#include <string>
#include <variant>
#include <vector>

namespace RTC {

/// A set of machines: addresses and networks of IPv4 and IPv6, or all machines.
class HostRanges {
  public:
    HostRanges() = default; ///< no machine
    /// Takes `192.168.0.2`, `192.168.0.0/24`, `fd00::1`, `fd00::/64` and `all`. Throws std::invalid_argument, one
    /// line, for any other text.
    explicit HostRanges(const std::vector<std::string>& texts);

    bool empty() const { return !all_ && networks_.empty(); }
    /// Returns whether the machine with this address is in the set. A text that is not an address is not. [any-thread]
    bool contains(const std::string& address) const;

  private:
    using Network = std::variant<boost::asio::ip::network_v4, boost::asio::ip::network_v6>;
    static Network parse(const std::string& text);

    bool all_ = false;
    std::vector<Network> networks_;
};

} // namespace RTC
