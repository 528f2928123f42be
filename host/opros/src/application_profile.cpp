// SPDX-License-Identifier: Apache-2.0
#include "host/opros/src/xml_file.hpp"

#include <algorithm>

namespace tandem::engine {
namespace {

PortReference port_reference(const XmlFile& xml, const pugi::xml_node& connection, const char* end) {
    const pugi::xml_node node = connection.child(end);
    if (!node) xml.fail(connection, std::string("<port_connection> lacks its <").append(end).append(">"));
    return {xml.required_attribute(node, "component_name"), xml.required_attribute(node, "port_name")};
}

PortType port_type(const XmlFile& xml, const pugi::xml_node& connection) {
    const std::string type = xml.required_attribute(connection, "port_type");
    if (type == "data") return OPROS_DATA;
    if (type == "event") return OPROS_EVENT;
    if (type == "service") return OPROS_SERVICE;
    xml.fail(connection, "port_type is '" + type + "', expected data, event or service");
}

void read_subcomponents(const XmlFile& xml, const pugi::xml_node& root, ApplicationProfile& profile) {
    for (const pugi::xml_node& node : root.child("subcomponents").children("subcomponent")) {
        Subcomponent component{
            xml.place(node), xml.required_text(node, "name"), xml.required_text(node, "reference"), {}};
        const auto same = [&](const Subcomponent& other) { return other.name == component.name; };
        if (std::any_of(profile.subcomponents.begin(), profile.subcomponents.end(), same))
            xml.fail(node, "component '" + component.name + "' is listed twice");
        for (const pugi::xml_node& property : node.child("properties").children("property"))
            component.properties.emplace_back(xml.required_attribute(property, "name"),
                                              property.child_value());
        profile.subcomponents.push_back(std::move(component));
    }
    if (profile.subcomponents.empty())
        xml.fail(root, "the application lists no <subcomponent> in <subcomponents>");
}

void require_component(const XmlFile& xml, const pugi::xml_node& node, const ApplicationProfile& profile,
                       const std::string& name) {
    std::string known;
    for (const Subcomponent& component : profile.subcomponents) {
        if (component.name == name) return;
        known += (known.empty() ? "" : ", ") + component.name;
    }
    xml.fail(node, "unknown component '" + name + "', the application has " + known);
}

} // namespace

ApplicationProfile read_application_profile(const std::filesystem::path& file) {
    const XmlFile xml(file);
    const pugi::xml_node root = xml.root({"package_profile", "application_profile"});
    ApplicationProfile profile;
    profile.place = xml.place(root);
    profile.name = xml.required_text(root, "name");
    read_subcomponents(xml, root, profile);
    for (const pugi::xml_node& node : root.child("port_connections").children("port_connection")) {
        Connection connection{xml.place(node), port_type(xml, node), port_reference(xml, node, "source"),
                              port_reference(xml, node, "target")};
        require_component(xml, node.child("source"), profile, connection.source.component);
        require_component(xml, node.child("target"), profile, connection.target.component);
        profile.connections.push_back(std::move(connection));
    }
    for (const pugi::xml_node& node : root.child("coordination").children("depends")) {
        Dependency dependency{xml.place(node), xml.required_attribute(node, "source"),
                              xml.required_attribute(node, "target")};
        require_component(xml, node, profile, dependency.source);
        require_component(xml, node, profile, dependency.target);
        profile.dependencies.push_back(std::move(dependency));
    }
    return profile;
}

std::filesystem::path find_component_profile(const ApplicationProfile& application,
                                             const Subcomponent& component,
                                             const std::vector<std::filesystem::path>& plugin_dirs) {
    const auto folder = application.place.file.parent_path();
    std::vector<std::filesystem::path> candidates{
        folder / component.name / component.reference,
        folder / application.place.file.stem() / component.reference,
        folder / component.reference,
    };
    for (const auto& dir : plugin_dirs) candidates.push_back(dir / component.reference);
    std::string looked;
    for (const auto& candidate : candidates) {
        if (std::filesystem::is_regular_file(candidate)) return candidate;
        looked += (looked.empty() ? "" : ", ") + candidate.string();
    }
    throw SetupError(component.place, "profile '" + component.reference + "' of component '" +
                                          component.name + "' not found: looked for " + looked);
}

} // namespace tandem::engine
