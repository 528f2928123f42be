// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/allowed_hosts.hpp"

#include "apps/tandem/monitor/web/peer.hpp"
#include "apps/tandem/output/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace tandem::monitor {
namespace {

/// Host names are compared in lower case, and addresses in their shortest form.
std::string normal_form(std::string name) {
    boost::system::error_code failure;
    const auto address = boost::asio::ip::make_address(name, failure);
    if (!failure) return plain_address(address).to_string();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return name;
}

bool is_digits(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Returns the normal form of NAME, NAME:PORT, [IPV6] or [IPV6]:PORT; an empty text for anything else.
std::string name_in(const std::string& host) {
    const bool is_bracketed = !host.empty() && host.front() == '[';
    const auto name_end = is_bracketed ? host.find(']') : host.find(':');
    const auto port_begin = is_bracketed && name_end != std::string::npos ? name_end + 1 : name_end;
    if (is_bracketed && name_end == std::string::npos) return {};
    if (port_begin < host.size() && (host[port_begin] != ':' || !is_digits(host.substr(port_begin + 1))))
        return {};
    return normal_form(is_bracketed ? host.substr(1, name_end - 1) : host.substr(0, name_end));
}

bool is_host_name(const std::string& name) {
    return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_';
    });
}

} // namespace

AllowedHosts::AllowedHosts(const std::vector<std::string>& more) {
    for (const std::string& text : more) {
        const bool is_bracketed = text.size() > 2 && text.front() == '[' && text.back() == ']';
        const std::string name = normal_form(is_bracketed ? text.substr(1, text.size() - 2) : text);
        boost::system::error_code failure;
        boost::asio::ip::make_address(name, failure);
        if (failure && !is_host_name(name))
            throw std::runtime_error(fmt::format(
                "--allow-host {}: expected a host name or an address without scheme and port, for example "
                "robot.local",
                command::replace_nonprintable(text)));
        names_.insert(name);
    }
}

bool AllowedHosts::allows(const std::string& host, const boost::asio::ip::address& local) const {
    const std::string name = name_in(host);
    return names_.count(name) != 0 || name == plain_address(local).to_string();
}

} // namespace tandem::monitor
