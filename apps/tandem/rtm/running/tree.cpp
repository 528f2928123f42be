// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/running/component_source.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <fmt/format.h>
#include <rtm/NVUtil.h>

namespace tandem::command {
namespace {

/// The data of a port in the tree.
struct PortEntry {
    std::string name, kind, type;
    std::vector<std::string> connected_with;
    nlohmann::json properties;  ///< dataport.*: what the port supports
    nlohmann::json connections; ///< ids, names, the other ports and properties of the connections
};

/// Returns the properties of data ports and their connections that are texts.
nlohmann::json dataport_properties(const SDOPackage::NVList& list) {
    nlohmann::json properties = nlohmann::json::object();
    for (CORBA::ULong i = 0; i < list.length(); ++i) {
        const std::string name(list[i].name);
        const char* value = nullptr; // belongs to the property
        if (name.compare(0, 9, "dataport.") == 0 && (list[i].value >>= value)) properties[name] = value;
    }
    return properties;
}

// Returns the name of a connection's other port, whose process may be gone.
std::string peer_name(RTC::PortService_ptr port) {
    try {
        RTC::PortProfile_var profile = port->get_port_profile();
        return static_cast<const char*>(profile->name);
    } catch (const CORBA::SystemException&) {
        return "(unreachable)";
    }
}

// Makes remote calls: one for the list, one for each port and one for each connected port.
std::vector<PortEntry> ports_of(RTC::RTObject_ptr component) {
    std::vector<PortEntry> lines;
    RTC::PortServiceList_var ports = component->get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        RTC::PortProfile_var profile = ports[i]->get_port_profile();
        PortEntry line{static_cast<const char*>(profile->name),
                       NVUtil::toString(profile->properties, "port.port_type"),
                       NVUtil::toString(profile->properties, "dataport.data_type"),
                       {},
                       dataport_properties(profile->properties),
                       nlohmann::json::array()};
        for (CORBA::ULong k = 0; k < profile->interfaces.length(); ++k) {
            const auto& one = profile->interfaces[k];
            // A service port has interfaces instead of a data type.
            line.type += fmt::format("{}{} {}", line.type.empty() ? "" : ", ",
                                     one.polarity == RTC::PROVIDED ? "provides" : "requires",
                                     static_cast<const char*>(one.type_name));
        }
        for (CORBA::ULong c = 0; c < profile->connector_profiles.length(); ++c) {
            const auto& connection = profile->connector_profiles[c];
            nlohmann::json others = nlohmann::json::array();
            for (CORBA::ULong p = 0; p < connection.ports.length(); ++p)
                if (!connection.ports[p]->_is_equivalent(ports[i]))
                    others.push_back(line.connected_with.emplace_back(peer_name(connection.ports[p])));
            line.connections.push_back({{"id", connection.connector_id.in()},
                                        {"name", connection.name.in()},
                                        {"with", others},
                                        {"properties", dataport_properties(connection.properties)}});
        }
        lines.push_back(line);
    }
    return lines;
}

} // namespace

// Creates text and JSON in one pass, because each read of a port is a remote call.
int rtm_tree(const RtmClientOptions& options) {
    const RtmClient client(options);
    nlohmann::json json = nlohmann::json::array();
    std::string text;
    const auto sources = enumerate_components(client);
    for (const auto& source : sources) {
        nlohmann::json components = nlohmann::json::array();
        text += (source.error.empty() ? source.kind + " " + source.address : source.error) + "\n";
        for (const auto& entry : source.components) {
            nlohmann::json ports = nlohmann::json::array();
            std::string error = entry.error;
            text += fmt::format("  {} {}\n", entry.instance.empty() ? entry.address : entry.instance,
                                error.empty() ? entry.describe_state() : "UNREACHABLE (" + error + ")");
            try {
                if (error.empty() && !CORBA::is_nil(entry.object.in()))
                    for (const auto& port : ports_of(entry.object.in())) {
                        ports.push_back({{"name", port.name},
                                         {"kind", port.kind},
                                         {"type", port.type},
                                         {"connected_with", port.connected_with},
                                         {"properties", port.properties},
                                         {"connections", port.connections}});
                        text += fmt::format("    {} {} {}\n", port.name, port.kind, port.type);
                        for (const auto& other : port.connected_with) text += "      <-> " + other + "\n";
                    }
            } catch (const CORBA::SystemException& e) {
                error = e._name(); // it has ended since it was listed
            }
            components.push_back({{"instance", entry.instance},
                                  {"address", entry.address},
                                  {"state", entry.state},
                                  {"error", error},
                                  {"ports", ports}});
        }
        json.push_back({{"kind", source.kind},
                        {"address", source.address},
                        {"error", source.error},
                        {"components", components}});
    }
    if (options.json)
        print_json(json);
    else
        print_text(text);
    throw_if_sources_failed(client, sources);
    return 0;
}

} // namespace tandem::command
