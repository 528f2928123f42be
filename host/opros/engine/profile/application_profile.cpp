// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/application_profile.hpp"

#include "host/opros/engine/profile/duplicate_connections.hpp"
#include "host/opros/engine/profile/port_type.hpp"
#include "host/opros/engine/profile/profile_structure.hpp"
#include "host/text/join.hpp"

#include <set>

namespace tandem::engine {
namespace {

/// A name becomes part of paths and messages. Linux's NAME_MAX limits the length in paths, so it is the limit for
/// both.
constexpr std::size_t max_name_length = 255;

/// The port of a master manager of OpenRTM-aist, where an address without a port is looked up.
constexpr int default_node_port = 2810;

/// Some tools write a value as an attribute, others as a child element of the same name.
std::string attribute_or_child(const pugi::xml_node& node, const char* name) {
    const std::string value = XmlFile::trim(node.attribute(name).value());
    return value.empty() ? XmlFile::child_text(node, name) : value;
}

/// Returns what is missing in <source> or <target>, or an empty string if both name a component and a port.
std::string port_reference_error(const pugi::xml_node& connection) {
    for (const char* element : {"source", "target"}) {
        const pugi::xml_node node = connection.child(element);
        if (!node) return "<port_connection> lacks its " + tag(element);
        for (const char* name : {"component_name", "port_name"})
            if (XmlFile::trim(node.attribute(name).value()).empty())
                return tag(element) + " lacks its attribute " + name;
    }
    return "";
}

PortReference port_reference(const pugi::xml_node& node) {
    return {XmlFile::trim(node.attribute("component_name").value()),
            XmlFile::trim(node.attribute("port_name").value())};
}

/// Returns the error in the port type, or an empty string if the type is known.
std::string port_type_error(const pugi::xml_node& node) {
    const std::string type = attribute_or_child(node, "port_type");
    if (parse_port_type(type)) return "";
    if (type.empty()) return tag(node.name()) + " lacks its attribute port_type";
    return "port_type is '" + type + "', expected data, event or service";
}

PortType port_type(const pugi::xml_node& node) {
    return parse_port_type(attribute_or_child(node, "port_type")).value_or(OPROS_DATA);
}

/// Reads one application or composite. Throws if the list of components is unusable. A wrong connection only keeps
/// its own error.
class AssemblyReader {
  public:
    AssemblyReader(const XmlFile& xml, const pugi::xml_node& root) : xml_(xml), root_(root) {
        profile_.location = xml_.location(root_);
        profile_.name = xml_.required_child_text(root_, "name");
        read_subcomponents();
        read_nodes();
        read_connections();
        read_dependencies();
        if (std::string(root_.name()) == "composite_component_profile") read_exports();
        profile_.structure_errors = find_structure_errors(xml_);
    }
    ApplicationProfile take_profile() && { return std::move(profile_); }

  private:
    void read_subcomponents() {
        for (const pugi::xml_node& node : root_.child("subcomponents").children("subcomponent"))
            profile_.subcomponents.push_back(read_subcomponent(node));
        if (profile_.subcomponents.empty())
            xml_.fail(root_, tag(root_.name()) +
                                 " lists no <subcomponent> in <subcomponents>, expected at least one");
    }

    Subcomponent read_subcomponent(const pugi::xml_node& node) {
        Subcomponent component{xml_.location(node),
                               xml_.required_child_text(node, "name"),
                               XmlFile::to_posix_path(xml_.required_child_text(node, "reference")),
                               {},
                               {},
                               XmlFile::child_text(node, "node_id")};
        if (component.name.size() > max_name_length || component.reference.size() > max_name_length)
            xml_.fail(node, "a component's name or reference has more than " +
                                std::to_string(max_name_length) + " bytes, expected a file's name");
        if (!component_names_.insert(component.name).second)
            xml_.fail(node, "component '" + component.name + "' is listed twice, expected one of each name");
        for (const pugi::xml_node& property : node.child("properties").children("property"))
            component.properties.emplace_back(xml_.required_attribute(property, "name"),
                                              property.child_value());
        return component;
    }

    void read_nodes() {
        profile_.local_node = XmlFile::child_text(root_, "local_node_id");
        for (const pugi::xml_node& node : root_.child("node_map").children("node")) {
            NodeAddress address{xml_.location(node), xml_.required_attribute(node, "id"), "", 0};
            double port = default_node_port;
            for (const pugi::xml_node& prop : node.children("prop")) {
                const std::string name = prop.attribute("name").value();
                if (name == "ip.addr") address.host = XmlFile::trim(prop.child_value());
                if (name == "ip.port") port = xml_.number(prop, default_node_port);
            }
            if (address.host.empty())
                xml_.fail(node, "node '" + address.id +
                                    "' has no address: expected <prop name=\"ip.addr\">ADDRESS</prop>");
            // It becomes a part of lists and addresses in the settings of rtm_host.
            if (address.host.find_first_not_of(
                    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                    ".:-_%") != std::string::npos)
                xml_.fail(node, "ip.addr of node '" + address.id + "' is '" + address.host +
                                    "', expected an IP address");
            if (port < 1 || port > 65535)
                xml_.fail(node, "ip.port of node '" + address.id + "' is not a port, expected 1 to 65535");
            address.port = static_cast<int>(port);
            profile_.nodes.push_back(std::move(address));
        }
    }

    void read_connections() {
        for (const pugi::xml_node& node : root_.child("port_connections").children("port_connection")) {
            ConnectionProfile connection{xml_.location(node), port_type(node),
                                         port_reference(node.child("source")),
                                         port_reference(node.child("target")), port_type_error(node)};
            if (connection.error.empty()) connection.error = port_reference_error(node);
            const std::string subscription = node.attribute("subscription_type").value();
            connection.newest_only = XmlFile::keyword(subscription) == "new";
            if (connection.error.empty() && !subscription.empty() && !connection.newest_only)
                connection.error = "subscription_type is '" + subscription +
                                   "', expected new, or no such attribute to send each message";
            for (const PortReference* port : {&connection.source, &connection.target})
                if (connection.error.empty()) connection.error = unknown_component_error(port->component);
            profile_.connections.push_back(std::move(connection));
        }
        mark_duplicate_connections(profile_.connections);
    }

    void read_dependencies() {
        for (const pugi::xml_node& node : root_.child("coordination").children("depends")) {
            Dependency dependency{xml_.location(node), xml_.required_attribute(node, "source"),
                                  xml_.required_attribute(node, "target")};
            require_known_component(node, dependency.source);
            require_known_component(node, dependency.target);
            profile_.dependencies.push_back(std::move(dependency));
        }
    }

    void read_exports() {
        std::set<std::string> exported_names;
        for (const pugi::xml_node& node : root_.child("export_ports").children("export_port")) {
            if (const std::string error = port_type_error(node); !error.empty()) xml_.fail(node, error);
            ExportedPort port{
                xml_.location(node),
                attribute_or_child(node, "export_port_name"),
                port_type(node),
                {attribute_or_child(node, "component_name"), attribute_or_child(node, "port_name")}};
            if (port.port.component.empty()) xml_.fail(node, "<export_port> lacks its component_name");
            if (port.port.port.empty()) xml_.fail(node, "<export_port> lacks its port_name");
            if (port.name.empty()) port.name = port.port.port;
            require_known_component(node, port.port.component);
            if (!exported_names.insert(port.name).second)
                xml_.fail(node, "port '" + port.name + "' is exported twice, expected one of each name");
            profile_.exports.push_back(std::move(port));
        }
    }

    /// Returns an empty string if the profile lists a component of this name, otherwise an error.
    std::string unknown_component_error(const std::string& name) const {
        if (component_names_.count(name) != 0) return "";
        return "unknown component '" + name + "', expected one of " + text::join(component_names_, ", ");
    }

    void require_known_component(const pugi::xml_node& node, const std::string& name) const {
        if (const std::string error = unknown_component_error(name); !error.empty()) xml_.fail(node, error);
    }

    const XmlFile& xml_;
    const pugi::xml_node root_;
    std::set<std::string> component_names_;
    ApplicationProfile profile_;
};

} // namespace

ApplicationProfile read_application_profile(const XmlFile& xml) {
    return AssemblyReader(xml, xml.root({"package_profile", "application_profile"})).take_profile();
}

ApplicationProfile read_application_profile(const std::filesystem::path& file) {
    return read_application_profile(XmlFile(file));
}

ApplicationProfile read_composite_profile(const XmlFile& xml) {
    return AssemblyReader(xml, xml.root({"composite_component_profile"})).take_profile();
}

ApplicationProfile read_composite_profile(const std::filesystem::path& file) {
    return read_composite_profile(XmlFile(file));
}

namespace {

/// Returns the file whose path differs only in the case of its file name; an empty path if there is none.
std::filesystem::path find_in_other_case(const std::filesystem::path& file) {
    std::error_code ignored; // a folder that cannot be read has no such file
    const std::string wanted = XmlFile::keyword(file.filename().string());
    const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (XmlFile::keyword(entry.path().filename().string()) == wanted && entry.is_regular_file(ignored))
            return entry.path();
    return {};
}

} // namespace

std::filesystem::path find_component_profile(const ApplicationProfile& application,
                                             const Subcomponent& component,
                                             const std::vector<std::filesystem::path>& plugin_dirs) {
    const auto folder = application.location.file.parent_path();
    std::vector<std::filesystem::path> candidates{
        folder / component.name / component.reference,
        folder / component.name / "profile" / component.reference, // where OPRoS tools put it
        folder / application.location.file.stem() / component.reference,
        folder / component.reference,
    };
    for (const auto& dir : plugin_dirs) candidates.push_back(dir / component.reference);
    if (std::filesystem::path(component.reference).is_absolute()) candidates = {component.reference};
    std::string searched;
    for (const auto& candidate : candidates) {
        std::error_code ignored; // a candidate that may not be accessed counts as missing
        if (std::filesystem::is_regular_file(candidate, ignored)) return candidate;
        searched += (searched.empty() ? "" : ", ") + candidate.string();
    }
    // Profiles from Windows, where the case of a file's name does not matter.
    for (const auto& candidate : candidates)
        if (auto file = find_in_other_case(candidate); !file.empty()) return file;
    throw SetupError(component.location, "profile '" + component.reference + "' of component '" +
                                             component.name + "' not found: looked for " + searched);
}

} // namespace tandem::engine
