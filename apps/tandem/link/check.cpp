// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/link/commands.hpp"
#include "apps/tandem/link/joined_ports.hpp"
#include "apps/tandem/link/made_conversion.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "host/opros/engine/load/plugin_dirs.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace tandem::command {
namespace {

using nlohmann::json;

std::string text_at(const json& object, const char* key) {
    return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : "";
}

/// Returns the port that a connection names; null if the component has no such port.
json port_of(const JoinedPorts& joined, const engine::PortReference& reference) {
    const auto component = joined.components.find(reference.component);
    if (component != joined.components.end())
        for (const auto& port : component->second.ports)
            if (port["name"] == reference.port) return port;
    return nullptr;
}

/// Returns the name that users know: EchoRtc0.word, not Adaptor.word.
std::string port_name(const JoinedPorts& joined, const engine::PortReference& reference) {
    const auto component = joined.components.find(reference.component);
    return (component == joined.components.end() ? reference.component : component->second.name()) + "." +
           reference.port;
}

/// Returns the conversion that AdaptorComp's property convert.PORT requests for either port; "" if there is none.
std::string asked_conversion(const JoinedPorts& joined, const engine::ConnectionProfile& connection) {
    for (const auto* end : {&connection.source, &connection.target}) {
        const auto component = joined.components.find(end->component);
        if (component == joined.components.end()) continue;
        const auto& properties = component->second.properties;
        const auto found = properties.find("convert." + end->port);
        if (found != properties.end()) return found->second;
    }
    return "";
}

/// Returns the conversion of values on this valid connection; "" if their bytes stay the same.
std::string conversion(const json& from, const json& to, const std::string& asked) {
    const std::string sent = text_at(from, "signature"), received = text_at(to, "signature");
    if (sent.empty() || received.empty() || text_at(from, "kind") == "event") return "";
    if (!asked.empty()) return asked;
    return made_conversion(sent, received);
}

/// Returns whether one of the two ends is behind a link.
bool crosses_a_link(const JoinedPorts& joined, const engine::ConnectionProfile& connection) {
    return std::any_of(joined.components.begin(), joined.components.end(), [&](const auto& each) {
        return !each.second.link.empty() &&
               (each.first == connection.source.component || each.first == connection.target.component);
    });
}

json describe_connections(const JoinedPorts& joined) {
    json connections = json::array();
    for (std::size_t i = 0; i < joined.application.connections.size(); ++i) {
        const auto& connection = joined.application.connections[i];
        if (!crosses_a_link(joined, connection) && joined.connection_errors[i].empty()) continue;
        const json from = port_of(joined, connection.source), to = port_of(joined, connection.target);
        connections.push_back(
            {{"from", port_name(joined, connection.source)},
             {"to", port_name(joined, connection.target)},
             {"from_port", from},
             {"to_port", to},
             {"conversion", from.is_null() || to.is_null() || !joined.connection_errors[i].empty()
                                ? ""
                                : conversion(from, to, asked_conversion(joined, connection))},
             {"location", connection.location.text()},
             {"error", joined.connection_errors[i]}});
    }
    return connections;
}

/// Returns the unconnected ports, with the reason.
json describe_unconnected(const JoinedPorts& joined) {
    std::set<std::string> connected;
    for (const auto& connection : joined.application.connections)
        connected.insert({connection.source.text(), connection.target.text()});
    json ports = json::array();
    for (const auto& [name, component] : joined.components)
        for (json port : component.ports) {
            const engine::PortReference reference{name, port["name"]};
            if (connected.count(reference.text()) != 0) continue;
            std::string reason = text_at(port, "reason"); // set for ports that cannot be connected
            if (reason.empty())
                reason = "no connection in " + joined.application.location.file.string() + " names it";
            json fitting = json::array();
            if (const auto found = joined.suggestions.find(reference.text());
                found != joined.suggestions.end())
                for (const auto& peer : found->second) fitting.push_back(port_name(joined, peer));
            ports.push_back({{"port", port_name(joined, reference)},
                             {"of", std::move(port)},
                             {"reason", reason},
                             {"fitting", std::move(fitting)}});
        }
    return ports;
}

json describe_links(const JoinedPorts& joined) {
    json links = json::array();
    for (const auto& [name, component] : joined.components)
        if (!component.link.empty())
            links.push_back({{"link", component.link},
                             {"adaptor", name},
                             {"rtc", component.rtc},
                             {"running", component.running}});
    return links;
}

// A service has one line per operation, in the notation of the component's model.
void add_rows(Table& table, const json& connection) {
    const json &from = connection["from_port"], &to = connection["to_port"];
    table.add_row({text_at(from.is_null() ? to : from, "kind"), text_at(connection, "from"),
                   text_at(from, "signature"), text_at(connection, "to"), text_at(to, "signature"),
                   connection["error"] == "" ? text_at(connection, "conversion") : "cannot be connected"});
    for (const json* port : {&from, &to})
        if (port->is_object() && port->contains("methods"))
            for (const auto& method : (*port)["methods"]) {
                const std::string name = "  " + text_at(method, "name"),
                                  signature = text_at(method, "signature");
                if (port == &from)
                    table.add_row({"", name, signature});
                else
                    table.add_row({"", "", "", name, signature});
            }
}

std::string fitting_text(const json& fitting) {
    std::string text;
    for (const auto& name : fitting)
        text += (text.empty() ? "; its type fits " : ", ") + name.get<std::string>();
    return text;
}

std::string format_report(const json& report) {
    std::string text;
    for (const auto& link : report["links"])
        text += "link " + text_at(link, "link") + ": " + text_at(link, "rtc") + " behind " +
                text_at(link, "adaptor") +
                (link["running"] == true ? ", running\n" : ", not running (ports from rtc.conf)\n");
    Table table({"kind", "from", "signature", "to", "signature", "conversion"});
    for (const auto& connection : report["connections"]) add_rows(table, connection);
    if (!table.empty()) text += "\n" + table.text();
    text += "\n";
    for (const auto& port : report["unconnected"])
        text +=
            "without a peer: " + text_at(port, "port") + " (" + text_at(port["of"], "kind") + " " +
            text_at(port["of"], "direction") +
            (text_at(port["of"], "signature").empty() ? "" : ", '" + text_at(port["of"], "signature") + "'") +
            "): " + text_at(port, "reason") + fitting_text(port["fitting"]) + "\n";
    for (const auto& connection : report["connections"])
        if (connection["error"] != "")
            text += text_at(connection, "location") +
                    ": cannot be connected: " + text_at(connection, "error") + "\n";
    for (const auto& error : report["errors"]) text += error.get<std::string>() + "\n";
    return text;
}

// Removes control characters, because lines may quote texts of components and other processes.
std::string printable(const std::string& text) {
    std::string out;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
        out += replace_control_characters(text.substr(begin, end - begin)) + "\n";
    return out;
}

} // namespace

int link_check(const LinkCheckOptions& options) {
    const RunFolder folder = find_run_folder(options.folder);
    if (folder.application.empty())
        throw std::runtime_error(options.folder.string() +
                                 " has no application profile in opros/, so nothing is joined");
    InspectOptions inspect;
    inspect.plugin_dirs = options.plugin_dirs;
    for (const auto& dir : engine::default_plugin_dirs()) inspect.plugin_dirs.push_back(dir);
    inspect.initialize = options.initialize;
    inspect.timeout_s = options.timeout_s;
    const JoinedPorts joined = find_joined_ports(folder, inspect);
    const json report{{"links", describe_links(joined)},
                      {"connections", describe_connections(joined)},
                      {"unconnected", describe_unconnected(joined)},
                      {"errors", joined.errors}};
    options.json ? print_json(report) : print_text(printable(format_report(report)));
    const bool refused = std::any_of(joined.connection_errors.begin(), joined.connection_errors.end(),
                                     [](const std::string& error) { return !error.empty(); });
    return refused || !joined.errors.empty() ? 1 : 0;
}

} // namespace tandem::command
