// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/running/component_source.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <fmt/format.h>
#include <rtm/NVUtil.h>

namespace tandem::command {
namespace {

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

nlohmann::json connections_of(RTC::PortService_ptr port, const RTC::PortProfile& profile) {
    nlohmann::json connections = nlohmann::json::array();
    for (CORBA::ULong c = 0; c < profile.connector_profiles.length(); ++c) {
        const auto& connection = profile.connector_profiles[c];
        nlohmann::json others = nlohmann::json::array();
        for (CORBA::ULong p = 0; p < connection.ports.length(); ++p)
            if (!connection.ports[p]->_is_equivalent(port)) others.push_back(peer_name(connection.ports[p]));
        connections.push_back({{"id", connection.connector_id.in()},
                               {"name", connection.name.in()},
                               {"with", others},
                               {"properties", dataport_properties(connection.properties)}});
    }
    return connections;
}

// Returns the data type; of a service port, which has none, its interfaces.
std::string type_of(const RTC::PortProfile& profile) {
    std::string type = NVUtil::toString(profile.properties, "dataport.data_type");
    for (CORBA::ULong k = 0; k < profile.interfaces.length(); ++k) {
        const auto& one = profile.interfaces[k];
        type += fmt::format("{}{} {}", type.empty() ? "" : ", ",
                            one.polarity == RTC::PROVIDED ? "provides" : "requires",
                            static_cast<const char*>(one.type_name));
    }
    return type;
}

// Makes remote calls: one for the list, one for each port and one for each connected port.
nlohmann::json ports_of(RTC::RTObject_ptr component) {
    nlohmann::json list = nlohmann::json::array();
    RTC::PortServiceList_var ports = component->get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        RTC::PortProfile_var profile = ports[i]->get_port_profile();
        const auto connections = connections_of(ports[i], profile.in());
        nlohmann::json connected_with = nlohmann::json::array();
        for (const auto& connection : connections)
            for (const auto& other : connection["with"]) connected_with.push_back(other);
        list.push_back({{"name", static_cast<const char*>(profile->name)},
                        {"kind", NVUtil::toString(profile->properties, "port.port_type")},
                        {"type", type_of(profile.in())},
                        {"connected_with", connected_with},
                        {"properties", dataport_properties(profile->properties)},
                        {"connections", connections}});
    }
    return list;
}

std::string tree_text(const ComponentSource& source, const nlohmann::json& components) {
    std::string text = (source.error.empty() ? source.kind + " " + source.address : source.error) + "\n";
    for (std::size_t i = 0; i < components.size(); ++i) {
        const ComponentEntry& entry = source.components[i];
        text +=
            fmt::format("  {} {}\n", entry.instance.empty() ? entry.address : entry.instance,
                        entry.error.empty() ? entry.describe_state() : "UNREACHABLE (" + entry.error + ")");
        for (const auto& port : components[i]["ports"]) {
            text += fmt::format("    {} {} {}\n", port["name"].get<std::string>(),
                                port["kind"].get<std::string>(), port["type"].get<std::string>());
            for (const auto& other : port["connected_with"])
                text += "      <-> " + other.get<std::string>() + "\n";
        }
    }
    return text;
}

} // namespace

nlohmann::json describe_components(const ComponentSource& source) {
    nlohmann::json components = nlohmann::json::array();
    for (const auto& entry : source.components) {
        nlohmann::json ports = nlohmann::json::array();
        std::string error = entry.error;
        try {
            if (error.empty() && !CORBA::is_nil(entry.object.in())) ports = ports_of(entry.object.in());
        } catch (const CORBA::SystemException& e) {
            error = e._name(); // it has ended since it was listed
        }
        components.push_back({{"instance", entry.instance},
                              {"address", entry.address},
                              {"state", entry.state},
                              {"error", error},
                              {"ports", ports}});
    }
    return components;
}

// Creates the text from the JSON, because each read of a port is a remote call.
int rtm_tree(const RtmClientOptions& options) {
    const RtmClient client(options);
    nlohmann::json json = nlohmann::json::array();
    std::string text;
    const auto sources = enumerate_components(client);
    for (const auto& source : sources) {
        const auto components = describe_components(source);
        text += tree_text(source, components);
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
