// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/duplicate_connections.hpp"
#include "host/opros/engine/profile/xml_file.hpp"

#include <set>

namespace tandem::engine {
namespace {

PortReference port_reference(const XmlFile& xml, const pugi::xml_node& connection, const char* end) {
    const pugi::xml_node node = connection.child(end);
    if (!node) xml.fail(connection, std::string("<port_connection> lacks its <").append(end).append(">"));
    return {xml.required_attribute(node, "component_name"), xml.required_attribute(node, "port_name")};
}

/// An attribute, or a child element of that name.
std::string named(const pugi::xml_node& node, const char* name) {
    const std::string value = XmlFile::trim(node.attribute(name).value());
    return value.empty() ? XmlFile::child_text(node, name) : value;
}

/// Empty if there is none.
std::string port_type_error(const pugi::xml_node& node) {
    const std::string type = named(node, "port_type"), word = XmlFile::keyword(type);
    if (word == "data" || word == "event" || word == "service") return "";
    if (word.empty()) return tag(node.name()) + " lacks its attribute port_type";
    return "port_type is '" + type + "', expected data, event or service";
}

PortType port_type(const XmlFile& xml, const pugi::xml_node& node) {
    if (const std::string error = port_type_error(node); !error.empty()) xml.fail(node, error);
    const std::string type = XmlFile::keyword(named(node, "port_type"));
    if (type == "data") return OPROS_DATA;
    return type == "event" ? OPROS_EVENT : OPROS_SERVICE;
}

constexpr std::size_t max_name_length = 255;

using Names = std::set<std::string>;

Names read_subcomponents(const XmlFile& xml, const pugi::xml_node& root, ApplicationProfile& profile) {
    Names names;
    for (const pugi::xml_node& node : root.child("subcomponents").children("subcomponent")) {
        Subcomponent component{xml.location(node),
                               xml.required_child_text(node, "name"),
                               XmlFile::to_posix_path(xml.required_child_text(node, "reference")),
                               {},
                               {}};
        // It becomes part of paths and of messages.
        if (component.name.size() > max_name_length || component.reference.size() > max_name_length)
            xml.fail(node, "a component's name or reference has more than " +
                               std::to_string(max_name_length) + " bytes, expected a file's name");
        if (!names.insert(component.name).second)
            xml.fail(node, "component '" + component.name + "' is listed twice, expected one of each name");
        for (const pugi::xml_node& property : node.child("properties").children("property"))
            component.properties.emplace_back(xml.required_attribute(property, "name"),
                                              property.child_value());
        profile.subcomponents.push_back(std::move(component));
    }
    if (profile.subcomponents.empty())
        xml.fail(root,
                 tag(root.name()) + " lists no <subcomponent> in <subcomponents>, expected at least one");
    return names;
}

/// Empty if there is such a component.
std::string unknown_component(const Names& names, const std::string& name) {
    if (names.count(name) != 0) return "";
    std::string known;
    for (const std::string& each : names) known += (known.empty() ? "" : ", ") + each;
    return "unknown component '" + name + "', expected one of " + known;
}

void require_component(const XmlFile& xml, const pugi::xml_node& node, const Names& names,
                       const std::string& name) {
    const std::string error = unknown_component(names, name);
    if (!error.empty()) xml.fail(node, error);
}

void read_connections(const XmlFile& xml, const pugi::xml_node& root, const Names& names,
                      ApplicationProfile& profile) {
    for (const pugi::xml_node& node : root.child("port_connections").children("port_connection")) {
        ConnectionProfile connection{xml.location(node), OPROS_DATA, port_reference(xml, node, "source"),
                                     port_reference(xml, node, "target"), port_type_error(node)};
        if (connection.error.empty()) connection.type = port_type(xml, node);
        if (connection.error.empty())
            connection.error = unknown_component(names, connection.source.component);
        if (connection.error.empty())
            connection.error = unknown_component(names, connection.target.component);
        profile.connections.push_back(std::move(connection));
    }
    mark_duplicate_connections(profile.connections);
    for (const pugi::xml_node& node : root.child("coordination").children("depends")) {
        Dependency dependency{xml.location(node), xml.required_attribute(node, "source"),
                              xml.required_attribute(node, "target")};
        require_component(xml, node, names, dependency.source);
        require_component(xml, node, names, dependency.target);
        profile.dependencies.push_back(std::move(dependency));
    }
}

void read_exports(const XmlFile& xml, const pugi::xml_node& root, const Names& names,
                  ApplicationProfile& profile) {
    Names exported;
    for (const pugi::xml_node& node : root.child("export_ports").children("export_port")) {
        ExportedPort port{xml.location(node),
                          named(node, "export_port_name"),
                          port_type(xml, node),
                          {named(node, "component_name"), named(node, "port_name")}};
        if (port.port.component.empty()) xml.fail(node, "<export_port> lacks its component_name");
        if (port.port.port.empty()) xml.fail(node, "<export_port> lacks its port_name");
        if (port.name.empty()) port.name = port.port.port;
        require_component(xml, node, names, port.port.component);
        if (!exported.insert(port.name).second)
            xml.fail(node, "port '" + port.name + "' is exported twice, expected one of each name");
        profile.exports.push_back(std::move(port));
    }
}

ApplicationProfile read(const XmlFile& xml, const pugi::xml_node& root) {
    ApplicationProfile profile;
    profile.location = xml.location(root);
    profile.name = xml.required_child_text(root, "name");
    const Names names = read_subcomponents(xml, root, profile);
    read_connections(xml, root, names, profile);
    if (std::string(root.name()) == "composite_component_profile") read_exports(xml, root, names, profile);
    return profile;
}

} // namespace

ApplicationProfile read_application_profile(const XmlFile& xml) {
    return read(xml, xml.root({"package_profile", "application_profile"}));
}

ApplicationProfile read_application_profile(const std::filesystem::path& file) {
    return read_application_profile(XmlFile(file));
}

ApplicationProfile read_composite_profile(const XmlFile& xml) {
    return read(xml, xml.root({"composite_component_profile"}));
}

ApplicationProfile read_composite_profile(const std::filesystem::path& file) {
    return read_composite_profile(XmlFile(file));
}

std::filesystem::path find_component_profile(const ApplicationProfile& application,
                                             const Subcomponent& component,
                                             const std::vector<std::filesystem::path>& plugin_dirs) {
    const auto folder = application.location.file.parent_path();
    std::vector<std::filesystem::path> candidates{
        folder / component.name / component.reference,
        folder / component.name / "profile" / component.reference, // as OPRoS tools lay out its sources
        folder / application.location.file.stem() / component.reference,
        folder / component.reference,
    };
    for (const auto& dir : plugin_dirs) candidates.push_back(dir / component.reference);
    std::error_code ignored; // what cannot be looked at is not there
    std::string looked;
    for (const auto& candidate : candidates) {
        if (std::filesystem::is_regular_file(candidate, ignored)) return candidate;
        looked += (looked.empty() ? "" : ", ") + candidate.string();
    }
    throw SetupError(component.location, "profile '" + component.reference + "' of component '" +
                                             component.name + "' not found: looked for " + looked);
}

} // namespace tandem::engine
