// SPDX-License-Identifier: Apache-2.0
// The settings of rtc.conf that decide who reaches the objects of an rtm_host, see host/rtm/runtime/network/access.cpp.
#include "apps/tandem/doctor/exposure.hpp"
#include "apps/tandem/output/format.hpp"
#include "host/text/join.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace tandem::doctor {
namespace {

std::string value_of(const RtmSettings& settings, const std::string& key) {
    const auto found = settings.find(key);
    return found == settings.end() ? "" : trim(found->second);
}

bool is_yes(const RtmSettings& settings, const std::string& key, bool unset = false) {
    std::string value = value_of(settings, key);
    if (value.empty()) return unset;
    std::transform(value.begin(), value.end(), value.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return value == "YES";
}

bool has_tls(const RtmSettings& settings) {
    return !value_of(settings, "corba.ssl.certificate_authority_file").empty() &&
           !value_of(settings, "corba.ssl.key_file").empty();
}

bool is_loopback(const std::string& host) {
    return host == "localhost" || host == "[::1]" || host.compare(0, 4, "127.") == 0;
}

/// HOST, HOST:PORT, :PORT, `all`, or one of them after giop:tcp: or giop:ssl:. Without a host, all addresses.
TcpEndpoint parse_endpoint(std::string text) {
    for (const std::string prefix : {"giop:tcp:", "giop:ssl:"})
        if (text.compare(0, prefix.size(), prefix) == 0) text.erase(0, prefix.size());
    if (text == "all") text.clear();
    const auto bracket = text.find(']');
    const auto colon = text.find(':', bracket == std::string::npos ? 0 : bracket);
    const std::string host = text.substr(0, colon),
                      port = colon == std::string::npos ? "" : text.substr(colon + 1);
    return {(host.empty() ? "every address" : host) + (port.empty() ? "" : ":" + port), !is_loopback(host)};
}

std::string addresses_of(const std::vector<TcpEndpoint>& endpoints) {
    return text::join(endpoints, ", ", &TcpEndpoint::address);
}

} // namespace

std::vector<TcpEndpoint> configured_endpoints(const RtmSettings& settings) {
    std::vector<TcpEndpoint> endpoints;
    std::string list = value_of(settings, "corba.endpoint");
    if (list.empty()) list = value_of(settings, "corba.endpoints");
    const bool has_servers = !value_of(settings, "corba.nameservers").empty();
    if (list.empty() && is_yes(settings, "naming.enable", has_servers)) list = "127.0.0.1";
    for (std::size_t begin = 0; begin < list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const std::string text = trim(list.substr(begin, end - begin));
        if (!text.empty() && text.compare(0, 10, "giop:unix:") != 0)
            endpoints.push_back(parse_endpoint(text));
        begin = end + 1;
    }
    if (!is_yes(settings, "manager.is_master")) return endpoints;
    const bool everywhere = std::any_of(endpoints.begin(), endpoints.end(), [](const TcpEndpoint& endpoint) {
        return endpoint.address.compare(0, 13, "every address") == 0;
    });
    std::string port = value_of(settings, "corba.master_manager");
    port = port.empty() ? "2810" : port.substr(port.rfind(':') + 1);
    endpoints.push_back(parse_endpoint((everywhere ? ":" : "127.0.0.1:") + port));
    return endpoints;
}

std::vector<CheckResult> check_rtm_host(const std::string& name, const RtmSettings& settings,
                                        const std::vector<TcpEndpoint>& endpoints) {
    if (endpoints.empty()) return {ok(name + ": TCP", "none, only this user by a Unix socket")};
    std::vector<CheckResult> results;
    const bool for_machines = std::any_of(endpoints.begin(), endpoints.end(),
                                          [](const auto& endpoint) { return endpoint.is_for_machines; });
    const std::string at = addresses_of(endpoints);
    if (has_tls(settings))
        results.push_back(ok(name + ": TCP", at + ", clients with a certificate (TLS)"));
    else if (!for_machines)
        results.push_back(ok(name + ": TCP", at + ", this machine only"));
    else
        results.push_back(
            warning(name + ": TCP", at + ", every machine that reaches it",
                    "any client can connect, configure and activate components: set corba.endpoints "
                    "to 127.0.0.1, or corba.ssl.* for TLS"));
    const auto add = [&](const char* key, const std::string& consequence) {
        results.push_back(warning(name + ": " + key,
                                  command::replace_control_characters(value_of(settings, key)), consequence));
    };
    if (!value_of(settings, "corba.permitted_users").empty())
        add("corba.permitted_users",
            "these users of this machine can do with the components what their owner can: "
            "name only users whom you trust");
    if (for_machines && is_yes(settings, "manager.modules.remote_load"))
        add("manager.modules.remote_load",
            "clients on other machines can load code, which runs with the rights of "
            "this user: remove the setting unless they need it");
    if (for_machines && is_yes(settings, "manager.remote_shutdown"))
        add("manager.remote_shutdown",
            "clients on other machines can end components and the host: remove the "
            "setting unless they need it");
    return results;
}

} // namespace tandem::doctor
