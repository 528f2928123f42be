// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/network/host_ranges.hpp"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <stdexcept>

namespace RTC {

namespace ip = boost::asio::ip;

HostRanges::HostRanges(const std::vector<std::string>& texts) {
    for (const auto& text : texts) {
        if (text == "all")
            all_ = true;
        else
            networks_.push_back(parse(text));
    }
}

HostRanges::Network HostRanges::parse(const std::string& text) {
    const bool is_v6 = text.find(':') != std::string::npos;
    const bool is_network = text.find('/') != std::string::npos;
    const std::string network = is_network ? text : text + (is_v6 ? "/128" : "/32");
    boost::system::error_code error;
    Network out = is_v6 ? Network(ip::make_network_v6(network, error).canonical())
                        : Network(ip::make_network_v4(network, error).canonical());
    if (error)
        throw std::invalid_argument("'" + text +
                                    "' is not an address: expected an address or a network, for example "
                                    "192.168.0.2 or 192.168.0.0/24, or all");
    return out;
}

bool HostRanges::contains(const std::string& address) const {
    boost::system::error_code error;
    const ip::address host = ip::make_address(address, error);
    if (error) return false;
    if (all_) return true;
    return std::any_of(networks_.begin(), networks_.end(), [&](const Network& network) {
        if (const auto* v4 = std::get_if<ip::network_v4>(&network))
            return host.is_v4() && ip::network_v4(host.to_v4(), v4->prefix_length()).canonical() == *v4;
        const auto& v6 = std::get<ip::network_v6>(network);
        return host.is_v6() && ip::network_v6(host.to_v6(), v6.prefix_length()).canonical() == v6;
    });
}

} // namespace RTC
