// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/link/commands.hpp"
#include "apps/tandem/link/made_conversion.hpp"
#include "apps/tandem/link/port_pairs.hpp"
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/peer_ports.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "apps/tandem/run/run_folder.hpp"
#include "apps/tandem/shared_ports/link_ports.hpp"
#include "apps/tandem/shared_ports/running_host.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/node/node_part.hpp"
#include "host/opros/engine/profile/application_profile.hpp"
#include "host/plugin/plugin_dirs.hpp"
#include "host/text/join.hpp"
#include "proxy/adaptor/property_check.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace tandem::command {
namespace {

/// A component of the application: an OPRoS component, or the RTC behind an AdaptorComp.
/// NOLINTNEXTLINE(bugprone-exception-escape): the check takes the assertions of nlohmann's move constructor for throws
struct JoinedComponent {
    engine::Subcomponent entry;
    nlohmann::json ports; ///< from describe_component(), with a "signature" of the data on the link
    std::string link;     ///< for an AdaptorComp; otherwise empty
    std::string rtc;      ///< the RTC behind it
    bool running = false; ///< an RTM host is sharing these ports now
    std::map<std::string, std::string> properties{}; ///< for an AdaptorComp
    /// Returns the name that users know: the RTC's name for an AdaptorComp.
    const std::string& name() const { return link.empty() ? entry.name : rtc; }
};

struct JoinedPorts {
    engine::ApplicationProfile application;
    std::map<std::string, JoinedComponent> components; ///< by their names in the application
    std::vector<std::string> connection_errors;        ///< one per connection; empty if it is possible
    /// For each unconnected port (COMPONENT.PORT in the application): unconnected ports on the other side of a link
    /// that fit it.
    std::map<std::string, std::vector<engine::PortReference>> suggestions;
    std::vector<std::string> errors; ///< reasons why a component or link could not be inspected
};

constexpr std::size_t max_trials =
    2000; // limit for large components; a trial takes microseconds to milliseconds

/// Collects the results, component by component.
class Collector {
  public:
    Collector(const RunFolder& folder, const InspectOptions& options)
        : options_(options), finder_(folder.rtc_conf, {options.plugin_dirs, options.timeout_s}) {
        options_.file = folder.application;
        joined_.application = engine::local_application(engine::read_application_profile(folder.application),
                                                        options.plugin_dirs);
    }

    JoinedPorts collect() {
        for (const auto& entry : joined_.application.subcomponents) {
            try {
                add(entry);
            } catch (const std::runtime_error& error) {
                joined_.errors.emplace_back(error.what());
            }
        }
        note_links_without_adaptor();
        try_connections();
        return std::move(joined_);
    }

  private:
    void add(const engine::Subcomponent& entry) {
        auto dirs = options_.plugin_dirs;
        dirs.insert(dirs.begin(), options_.file.parent_path());
        const auto file = entry.file.empty()
                              ? engine::find_component_profile(joined_.application, entry, dirs)
                              : entry.file;
        const auto profile = engine::read_component_profile(file);
        const auto library = engine::find_component_library(profile, dirs);
        if (is_adaptor(library))
            return add_adaptor(entry, adaptor_link(entry, profile), adaptor_properties(entry, profile));
        engine::require_opros_component(library);
        joined_.components[entry.name] = {
            entry, describe_in_child(library, file, options_)["ports"], "", "", false, {}};
    }

    void add_adaptor(const engine::Subcomponent& entry, const std::string& link,
                     std::map<std::string, std::string> properties) {
        joined_links_.push_back(link);
        const auto shared = finder_.find(link);
        if (!shared) {
            const auto links = finder_.configured_links();
            const std::string named = text::join(links, ", ", [](const auto& each) { return each.first; });
            throw engine::SetupError(
                entry.location,
                "component '" + entry.name + "' joins link '" + link +
                    "', but no InterceptorComp in rtc.conf has this link (links in rtc.conf: " +
                    (named.empty() ? "none" : named) + ")");
        }
        std::vector<std::string> names;
        names.reserve(properties.size());
        for (const auto& [name, value] : properties) names.push_back(name);
        auto lines = adaptor::find_properties_without_port(names, shared->table);
        for (auto& line : adaptor::find_unknown_properties(names)) lines.push_back(std::move(line));
        for (const auto& line : lines) joined_.errors.push_back("component '" + entry.name + "': " + line);
        tables_[entry.name] = link::encode_as_text(shared->table);
        joined_.components[entry.name] = {entry,
                                          describe_mirrors(shared->table, event_ports(properties)),
                                          link,
                                          shared->table.component_names(),
                                          shared->running,
                                          std::move(properties)};
    }

    void note_links_without_adaptor() {
        try {
            for (const auto& [link, rtc] : finder_.configured_links())
                if (std::find(joined_links_.begin(), joined_links_.end(), link) == joined_links_.end())
                    joined_.errors.push_back(finder_.conf().string() + ": InterceptorComp shares " + rtc +
                                             " on link '" + link +
                                             "', but no AdaptorComp of the application joins it");
        } catch (const std::runtime_error& error) {
            // The hosts may be running even if the probe fails, for example because a device is in use.
            if (tables_.empty()) joined_.errors.emplace_back(error.what());
        }
    }

    /// Tries the application's connections, and possible connections between unconnected ports.
    void try_connections() {
        std::vector<TrialConnection> trials;
        auto& errors = joined_.connection_errors;
        for (const auto& connection : joined_.application.connections) {
            errors.push_back(connection.error);
            if (is_known(connection))
                trials.push_back({connection.type, connection.source, connection.target});
        }
        const std::size_t own = trials.size();
        add_suggestions(trials);
        std::vector<std::string> excluded;
        for (const auto& entry : joined_.application.subcomponents)
            if (joined_.components.count(entry.name) == 0) excluded.push_back(entry.name);
        const auto found = try_connections_in_child(trials, excluded, tables_, options_);
        std::size_t next = 0;
        for (std::size_t i = 0; i < errors.size(); ++i)
            if (is_known(joined_.application.connections[i])) errors[i] = found.at(next++);
        for (std::size_t i = own; i < trials.size(); ++i) {
            if (!found.at(i).empty()) continue;
            joined_.suggestions[trials[i].source.text()].push_back(trials[i].target);
            joined_.suggestions[trials[i].target.text()].push_back(trials[i].source);
        }
    }

    void add_suggestions(std::vector<TrialConnection>& trials) const {
        std::set<std::string> connected;
        for (const auto& connection : joined_.application.connections)
            connected.insert({connection.source.text(), connection.target.text()});
        const auto free_ports = [&](const JoinedComponent& component) {
            nlohmann::json ports = nlohmann::json::array();
            for (const auto& port : component.ports)
                if (connected.count(component.entry.name + "." + port["name"].get<std::string>()) == 0)
                    ports.push_back(port);
            return ports;
        };
        for (const auto& [adaptor_name, adaptor] : joined_.components)
            for (const auto& [name, component] : joined_.components) {
                if (adaptor.link.empty() || !component.link.empty()) continue;
                for (const auto& pair : possible_pairs(free_ports(component), free_ports(adaptor))) {
                    if (trials.size() >= max_trials) return;
                    engine::PortReference opros{name, pair.opros["name"]},
                        rtc{adaptor_name, pair.rtc["name"]};
                    if (!pair.from_opros()) std::swap(opros, rtc);
                    trials.push_back({port_type(pair.opros), opros, rtc});
                }
            }
    }

    bool is_known(const engine::ConnectionProfile& connection) const {
        return connection.error.empty() && joined_.components.count(connection.source.component) != 0 &&
               joined_.components.count(connection.target.component) != 0;
    }

    InspectOptions options_;
    LinkPortFinder finder_;
    JoinedPorts joined_;
    std::vector<std::string> joined_links_;
    std::map<std::string, std::string> tables_; ///< of each AdaptorComp, for the child process
};

/// Finds the ports of all components and tries each connection in a child process. The ports of RTCs come from running
/// hosts, or otherwise from the rtc.conf. Throws std::runtime_error if the application cannot be read.
JoinedPorts find_joined_ports(const RunFolder& folder, const InspectOptions& options) {
    return Collector(folder, options).collect();
}

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

} // namespace

int link_check(const LinkCheckOptions& options) {
    const RunFolder folder = find_run_folder(options.folder);
    if (folder.application.empty())
        throw std::runtime_error(options.folder.string() +
                                 " has no application profile in opros/, so nothing is joined");
    InspectOptions inspect;
    inspect.plugin_dirs = options.plugin_dirs;
    for (const auto& dir : plugin::default_plugin_dirs("opros")) inspect.plugin_dirs.push_back(dir);
    inspect.initialize = options.initialize;
    inspect.timeout_s = options.timeout_s;
    const JoinedPorts joined = find_joined_ports(folder, inspect);
    const json report{{"links", describe_links(joined)},
                      {"connections", describe_connections(joined)},
                      {"unconnected", describe_unconnected(joined)},
                      {"errors", joined.errors}};
    options.json ? print_json(report) : print_text(format_report(report));
    const bool refused = std::any_of(joined.connection_errors.begin(), joined.connection_errors.end(),
                                     [](const std::string& error) { return !error.empty(); });
    return refused || !joined.errors.empty() ? 1 : 0;
}

} // namespace tandem::command
