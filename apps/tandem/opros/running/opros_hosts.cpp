// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/running/opros_hosts.hpp"

#include "host/local/local_endpoint.hpp"
#include "host/local/send_request.hpp"
#include "host/text/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <optional>
#include <stdexcept>

namespace tandem::command {
namespace {

using nlohmann::json;

// The host has the same time limit. Its own answer at that limit says more about the reason, so it gets extra time.
constexpr double answer_slack_s = 1;

/// Throws local::NobodyListens, and std::runtime_error if the host does not answer.
json send(const OprosHost& host, json request, double timeout_s) {
    request["timeout_s"] = timeout_s;
    const std::chrono::milliseconds limit(static_cast<long>(1000 * (timeout_s + answer_slack_s)));
    const auto reply =
        local::send_request(host.socket, request.dump(-1, ' ', false, json::error_handler_t::replace), limit);
    if (!reply)
        throw std::runtime_error(fmt::format(
            "opros_host {} does not answer within {} s: it is stopped, or the machine is busy; allow more "
            "time with --timeout",
            host.pid, timeout_s));
    json parsed = json::parse(*reply, nullptr, false);
    if (!parsed.is_object())
        throw std::runtime_error(
            fmt::format("opros_host {} sends a reply that is not a JSON object", host.pid));
    if (parsed.contains("error")) throw std::runtime_error(parsed.value("error", ""));
    return parsed;
}

bool has_component(const OprosHost& host, const std::string& name) {
    if (host.list.is_null()) return false;
    for (const auto& component : host.list.value("components", json::array()))
        if (component.value("name", "") == name) return true;
    return false;
}

bool is_called(const OprosHost& host, const std::string& name) {
    return name == std::to_string(host.pid) ||
           (!host.list.is_null() && name == host.list.value("application", ""));
}

/// The line for a name that no component has.
std::string unknown_component(const std::vector<OprosHost>& hosts, const std::string& name) {
    std::vector<std::string> known, silent;
    for (const auto& host : hosts) {
        if (!host.error.empty()) silent.push_back(host.error);
        if (!host.list.is_null())
            for (const auto& component : host.list.value("components", json::array()))
                known.push_back(component.value("name", ""));
    }
    if (hosts.empty())
        return fmt::format("there is no component {}: no opros_host of this user is running on this machine",
                           name);
    return fmt::format("no running opros_host has a component {}{} (there are: {}){}{}", name,
                       text::did_you_mean(name, known),
                       known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")),
                       silent.empty() ? "" : "; ", fmt::join(silent, "; "));
}

} // namespace

std::vector<OprosHost> find_opros_hosts(const OprosClientOptions& options) {
    local::remove_ended_endpoints(local::opros_endpoint);
    std::vector<OprosHost> hosts;
    for (const auto& endpoint : local::find_local_endpoints(local::opros_endpoint)) {
        OprosHost host{endpoint.pid, endpoint.socket, nullptr, ""};
        try {
            host.list = send(host, {{"command", "list"}}, options.timeout_s);
        } catch (const local::NobodyListens&) {
            continue; // it has ended
        } catch (const std::runtime_error& error) {
            host.error = error.what();
        }
        hosts.push_back(std::move(host));
    }
    return hosts;
}

RunningComponent find_running_component(const OprosClientOptions& options, const std::string& name) {
    const auto hosts = find_opros_hosts(options);
    const auto slash = name.rfind('/');
    const std::string host_name = slash == std::string::npos ? "" : name.substr(0, slash);
    const std::string component = slash == std::string::npos ? name : name.substr(slash + 1);
    std::vector<const OprosHost*> found;
    for (const auto& host : hosts)
        if ((host_name.empty() || is_called(host, host_name)) && has_component(host, component))
            found.push_back(&host);
    if (found.empty()) throw std::runtime_error(unknown_component(hosts, name));
    if (found.size() > 1) {
        std::vector<std::string> names;
        names.reserve(found.size());
        for (const auto* host : found) names.push_back(fmt::format("{}/{}", host->pid, component));
        throw std::runtime_error(fmt::format("{} hosts have a component {}: name one of {}", found.size(),
                                             name, fmt::join(names, ", ")));
    }
    return {*found.front(), component};
}

json request_component(const OprosClientOptions& options, const RunningComponent& component,
                       const std::string& command, const json& more) {
    json request = more;
    request["command"] = command;
    request["component"] = component.name;
    try {
        return send(component.host, std::move(request), options.timeout_s);
    } catch (const local::NobodyListens&) {
        throw std::runtime_error(fmt::format("opros_host {} has ended", component.host.pid));
    }
}

} // namespace tandem::command
