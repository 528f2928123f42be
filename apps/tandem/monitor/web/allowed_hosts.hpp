// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <boost/asio/ip/address.hpp>

#include <set>
#include <string>
#include <vector>

namespace tandem::monitor {

/// The names by which clients may address the monitor. The name of another site can resolve to this machine (DNS
/// rebinding). The site's page then counts as the monitor's own in a browser; only the header Host tells them apart.
class AllowedHosts {
  public:
    /// `more`: names in addition to localhost, 127.0.0.1 and ::1. Throws std::runtime_error with one line for a text
    /// that is neither a host name nor an address.
    explicit AllowedHosts(const std::vector<std::string>& more = {});

    /// Returns whether a request with this header `Host` may be answered. `local`: this end's IP address; a `Host` with
    /// this address is always allowed, because no name had to be resolved.
    bool allows(const std::string& host, const boost::asio::ip::address& local) const;

  private:
    std::set<std::string> names_{"localhost", "127.0.0.1", "::1"};
};

} // namespace tandem::monitor
