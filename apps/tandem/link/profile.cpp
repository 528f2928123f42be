// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/link/commands.hpp"
#include "apps/tandem/link/component_pair.hpp"
#include "apps/tandem/link/join_folder.hpp"
#include "apps/tandem/link/port_pairs.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "apps/tandem/shared_ports/rtc_conf_ports.hpp"
#include "apps/tandem/shared_ports/running_host.hpp"
#include "host/opros/engine/load/plugin_dirs.hpp"
#include "proxy/adaptor/property_check.hpp"
#include "proxy/wire/signature_match.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Names of links are file names in shared memory.
std::string as_link_name(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return !(std::isalnum(c) || c == '-' || c == '_'); },
        '_');
    return text.substr(0, 60);
}

/// Returns the ports of AdaptorComp: the mirrors and its own port.
json adaptor_ports(const link::PortTable& table, const std::set<std::string>& event_ports) {
    json ports = describe_mirrors(table, event_ports);
    ports.push_back({{"name", "linkState"}, {"kind", "data"}, {"direction", "output"}, {"type", nullptr}});
    return ports;
}

// Connects each pair in a child process, so that the host's own check decides.
void find_errors(std::vector<PortPair>& pairs, const ComponentPair& components, const link::PortTable& table,
                 const InspectOptions& options) {
    std::vector<TrialConnection> trials;
    for (const auto& pair : pairs) {
        engine::PortReference opros{components.opros.name, pair.opros["name"]},
            rtc{adaptor_name, pair.rtc["name"]};
        if (!pair.from_opros()) std::swap(opros, rtc);
        trials.push_back({port_type(pair.opros), opros, rtc});
    }
    const auto errors =
        try_connections_in_child(trials, {}, {{adaptor_name, link::encode_as_text(table)}}, options);
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].error = errors.at(i);
}

/// Returns the RTC's data ports whose messages can be events: an id and a content.
std::set<std::string> possible_event_ports(const link::PortTable& table) {
    std::set<std::string> names;
    for (const auto& port : table.ports) {
        if (!port.has_ring() || port.is_event_in_port()) continue;
        auto type = wire::parse_signature(port.signature);
        if (wire::is_timed(type)) type = wire::without_time(type);
        if (type.children.size() > 1 && type.children.front().kind == wire::Kind::string)
            names.insert(port.name);
    }
    return names;
}

/// Returns those of these ports that fit an event port of the OPRoS component. Writes the application with them as
/// event ports.
std::set<std::string> find_event_ports(const JoinFolder& folder, const ComponentPair& components,
                                       const json& opros_ports, const link::PortTable& table,
                                       const InspectOptions& options) {
    json events = json::array();
    for (const auto& port : opros_ports)
        if (port["kind"] == "event") events.push_back(port);
    const auto possible = possible_event_ports(table);
    std::set<std::string> found;
    if (events.empty() || possible.empty()) return found;
    folder.write_application(components, {}, possible);
    auto pairs = possible_pairs(events, describe_mirrors(table, possible));
    find_errors(pairs, components, table, options);
    for (const auto& pair : pairs)
        if (const std::string name = pair.rtc["name"]; pair.error.empty() && possible.contains(name))
            found.insert(name);
    return found;
}

/// Names the files only if `written`.
json report(const ComponentPair& components, const JoinFolder& folder, const PortMatch& match,
            const std::vector<std::string>& notes, bool written) {
    json connections = json::array();
    for (const auto& pair : match.pairs) {
        const std::string opros = components.opros.name + "." + pair.opros["name"].get<std::string>(),
                          rtc = components.type + "0." + pair.rtc["name"].get<std::string>();
        connections.push_back({{"kind", pair.opros["kind"]},
                               {"from", pair.from_opros() ? opros : rtc},
                               {"to", pair.from_opros() ? rtc : opros},
                               {"matched_by", pair.matched}});
    }
    json report{{"link", folder.link()},
                {"connections", connections},
                {"not_connected", match.left_out},
                {"notes", notes}};
    if (written) {
        report["application"] = folder.application().string();
        report["rtc_conf"] = folder.rtc_conf().string();
    }
    return report;
}

void print_report(const json& report, const std::string& folder) {
    std::string text;
    const bool written = report.contains("application");
    if (written) {
        text = "link       " + report["link"].get<std::string>() + "\nwritten    " +
               report["application"].get<std::string>() + "\n           " +
               report["rtc_conf"].get<std::string>() + "\n\n";
        Table table({"kind", "from", "to", "matched by"});
        for (const auto& each : report["connections"])
            table.add_row({each["kind"], each["from"], each["to"], each["matched_by"]});
        text += table.empty() ? "no port can be connected\n" : table.text();
        if (!report["not_connected"].empty()) text += "\n";
    }
    for (const auto& line : report["not_connected"])
        text += "not connected: " + replace_control_characters(line.get<std::string>()) + "\n";
    for (const auto& line : report["notes"])
        text += "note: " + replace_control_characters(line.get<std::string>()) + "\n";
    print_text(text + (written ? "\nnext: tandem run " + folder + "\n" : ""));
}

} // namespace

int link_profile(const LinkProfileOptions& options) {
    const ComponentPair components = find_component_pair(options);
    const fs::path out =
        options.out.empty() ? fs::path(components.opros.name + "-" + components.type) : options.out;
    JoinFolder folder(out, as_link_name(options.link.empty() ? components.opros.name + "-" + components.type
                                                             : options.link));
    for (const auto& property : options.properties) folder.add_property(property);
    auto notes = folder.write_rtc_conf(components);
    folder.write_application(components, {}, {});

    RtcConfOptions conf_options;
    conf_options.timeout_s = options.timeout_s;
    const auto table = probe_rtc_conf(folder.rtc_conf(), conf_options).at(folder.link());
    InspectOptions inspect;
    inspect.file = folder.application();
    inspect.plugin_dirs = engine::default_plugin_dirs();
    inspect.initialize = options.initialize;
    inspect.timeout_s = options.timeout_s;
    const json opros_ports =
        describe_in_child(components.library, components.opros.location.file, inspect)["ports"];
    const auto event_ports = find_event_ports(folder, components, opros_ports, table, inspect);
    folder.write_application(components, {}, event_ports);
    const json rtc_ports = adaptor_ports(table, event_ports);
    auto pairs = possible_pairs(opros_ports, rtc_ports);
    find_errors(pairs, components, table, inspect);
    const auto match =
        match_ports(components.opros.name, opros_ports, components.type + "0", rtc_ports, pairs);
    if (opros_ports.empty() && !options.initialize)
        notes.push_back(
            components.opros.name +
            " creates its ports in onInitialize(); to run it in a child process, use --initialize");
    const auto without_port = adaptor::find_properties_without_port(folder.property_names(), table);
    notes.insert(notes.end(), without_port.begin(), without_port.end());
    const auto unknown = adaptor::find_unknown_properties(folder.property_names());
    notes.insert(notes.end(), unknown.begin(), unknown.end());
    folder.write_application(components, match.pairs, event_ports);
    // If properties share a component as an RTC, its connections are made on the RTM side.
    const bool joins = !match.pairs.empty() || folder.has_property("share");
    if (joins) folder.keep();

    const json result = report(components, folder, match, notes, joins);
    options.json ? print_json(result) : print_report(result, out.string());
    if (!joins)
        throw std::runtime_error("no port of " + components.opros.name + " fits one of " + components.type +
                                 "0, for the reasons above, so nothing is written; make ports fit with "
                                 "--property convert.PORT=... or names.PORT=...");
    return 0;
}

} // namespace tandem::command
