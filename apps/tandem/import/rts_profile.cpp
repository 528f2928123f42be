// SPDX-License-Identifier: Apache-2.0
// The format is defined by RtsProfile.xsd of OpenRTP-aist and by the Python package rtsprofile. Elements and attributes
// are in the namespaces rts and rtsExt; a file may choose their prefixes.
#include "apps/tandem/import/rts_profile.hpp"

#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/output/format.hpp"
#include "host/opros/engine/profile/xml_file.hpp"
#include "host/text/parse_number.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <string_view>

namespace tandem::command {
namespace {

using engine::XmlFile;

std::string_view without_prefix(std::string_view name) {
    const auto colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

std::string attribute(const pugi::xml_node& node, std::string_view name) {
    for (const auto& each : node.attributes())
        if (without_prefix(each.name()) == name) return XmlFile::trim(each.value());
    return "";
}

void require_plain(const XmlFile& xml, const pugi::xml_node& node, const char* name,
                   const std::string& value) {
    const auto is_plain = [](unsigned char c) {
        return c >= ' ' && c != 127 && !std::strchr(",&?:=\\()", c);
    };
    if (!std::all_of(value.begin(), value.end(), is_plain))
        xml.fail(node, std::string(name) + " '" + replace_control_characters(value) +
                           "' has a character that rtc.conf does not allow in names (, & ? : = \\ ( ) or a "
                           "control character)");
}

std::string required(const XmlFile& xml, const pugi::xml_node& node, const char* name) {
    std::string value = attribute(node, name);
    if (value.empty()) xml.fail(node, engine::tag(node.name()) + " lacks its attribute " + name);
    return value;
}

// Returns a name that is safe as part of a key or of a list entry in rtc.conf.
std::string required_name(const XmlFile& xml, const pugi::xml_node& node, const char* name) {
    std::string value = required(xml, node, name);
    require_plain(xml, node, name, value);
    return value;
}

std::vector<pugi::xml_node> children(const pugi::xml_node& node, std::string_view name) {
    std::vector<pugi::xml_node> found;
    for (const auto& child : node.children())
        if (without_prefix(child.name()) == name) found.push_back(child);
    return found;
}

// Parses RTC:VENDOR:CATEGORY:TYPE:VERSION. VENDOR may contain colons.
void read_id(const XmlFile& xml, const pugi::xml_node& node, RtsComponent& component) {
    const std::string id = required(xml, node, "id");
    std::vector<std::string> parts(1);
    for (const char c : id) c == ':' ? parts.emplace_back() : parts.back().append(1, c);
    if (parts.size() < 5 || parts.front() != "RTC" || parts[parts.size() - 2].empty())
        xml.fail(node, "id is '" + id + "', expected RTC:VENDOR:CATEGORY:TYPE:VERSION");
    component.type = parts[parts.size() - 2];
    component.category = parts[parts.size() - 3];
    for (const auto& part : {component.type, component.category}) require_plain(xml, node, "id", part);
}

double rate_of(const pugi::xml_node& context) {
    const double rate = text::parse_number(attribute(context, "rate")).value_or(0);
    return rate > 0 && rate < 1e9 ? rate : 0;
}

// Parses HOST[:PORT]/CONTEXT/NAME.rtc.
std::string path_of(const XmlFile& xml, const pugi::xml_node& node, const std::string& path) {
    require_plain(xml, node, "path", path.substr(path.find('/') == std::string::npos ? 0 : path.find('/')));
    const std::string host = path.substr(0, path.find('/'));
    const auto is_of_host = [](unsigned char c) {
        return std::isalnum(c) || std::strchr(".-_:[]*", c) != nullptr;
    };
    if (!std::all_of(host.begin(), host.end(), is_of_host))
        xml.fail(node,
                 "path '" + replace_control_characters(path) + "', expected HOST:PORT/CONTEXT/NAME.rtc");
    return path;
}

RtsComponent read_component(const XmlFile& xml, const pugi::xml_node& node) {
    RtsComponent component;
    component.location = xml.location(node);
    component.name = required_name(xml, node, "instanceName");
    read_id(xml, node, component);
    component.path = path_of(xml, node, attribute(node, "pathUri"));
    component.active_set = attribute(node, "activeConfigurationSet");
    component.composite_type = attribute(node, "compositeType");
    if (component.composite_type == "None") component.composite_type.clear();
    for (const auto& set : children(node, "ConfigurationSets")) {
        RtsConfigurationSet read{required_name(xml, set, "id"), {}};
        if (read.id.starts_with("_")) continue;
        for (const auto& value : children(set, "ConfigurationData"))
            read.values.emplace_back(required_name(xml, value, "name"), attribute(value, "data"));
        component.sets.push_back(std::move(read));
    }
    if (const auto contexts = children(node, "ExecutionContexts"); !contexts.empty()) {
        component.kind = attribute(contexts.front(), "kind");
        component.rate = rate_of(contexts.front());
    }
    return component;
}

RtsPort read_port(const XmlFile& xml, const pugi::xml_node& connector, const std::string& end) {
    const auto found = children(connector, end);
    if (found.empty()) xml.fail(connector, engine::tag(connector.name()) + " lacks its <" + end + ">");
    RtsPort port{required_name(xml, found.front(), "instanceName"),
                 required_name(xml, found.front(), "portName"), ""};
    if (port.port.starts_with(port.component + ".")) port.port.erase(0, port.component.size() + 1);
    for (const auto& property : children(found.front(), "Properties"))
        if (attribute(property, "name") == "COMPONENT_PATH_ID")
            port.path = path_of(xml, property, attribute(property, "value"));
    return port;
}

void add(RtsProperties& properties, const std::string& key, const std::string& value) {
    const bool known = std::any_of(properties.begin(), properties.end(),
                                   [&](const auto& property) { return property.first == key; });
    if (!known && !value.empty()) properties.emplace_back(key, value);
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

RtsConnection read_connection(const XmlFile& xml, const pugi::xml_node& node, bool is_service) {
    const std::string kind = is_service ? "ServicePort" : "DataPort";
    RtsConnection connection{xml.location(node),
                             is_service,
                             read_port(xml, node, "source" + kind),
                             read_port(xml, node, "target" + kind),
                             {}};
    // Tools add these properties; they repeat and extend the standard's attributes.
    for (const auto& property : children(node, "Properties"))
        add(connection.properties, attribute(property, "name"), attribute(property, "value"));
    if (is_service) return connection;
    const std::string subscription = lower(attribute(node, "subscriptionType"));
    add(connection.properties, "dataport.interface_type", lower(attribute(node, "interfaceType")));
    add(connection.properties, "dataport.dataflow_type", lower(attribute(node, "dataflowType")));
    add(connection.properties, "dataport.subscription_type", subscription);
    if (subscription == "periodic")
        add(connection.properties, "dataport.push_rate", attribute(node, "pushInterval"));
    return connection;
}

bool is_rts_root(const pugi::xml_node& root) { return without_prefix(root.name()) == "RtsProfile"; }

} // namespace

bool is_rts_profile(const std::filesystem::path& file) {
    try {
        return is_rts_root(XmlFile(file).root());
    } catch (const engine::SetupError&) {
        return true; // reading it later reports the error
    }
}

RtsProfile read_rts_profile(const std::filesystem::path& file) {
    const XmlFile xml(file);
    const auto root = xml.root();
    if (!is_rts_root(root))
        xml.fail(root, "the root element is " + engine::tag(root.name()) +
                           ", expected <rts:RtsProfile> of an RTSystem profile");
    RtsProfile profile{file, {}, {}, {}};
    for (const auto& node : children(root, "Components"))
        profile.components.push_back(read_component(xml, node));
    if (profile.components.empty()) xml.fail(root, "the system has no component (<rts:Components>)");
    for (const auto& node : children(root, "DataPortConnectors"))
        profile.connections.push_back(read_connection(xml, node, false));
    for (const auto& node : children(root, "ServicePortConnectors"))
        profile.connections.push_back(read_connection(xml, node, true));
    for (const char* name :
         {"StartUp", "ShutDown", "Activation", "Deactivation", "Resetting", "Initializing", "Finalizing"})
        for (const auto& node : children(root, name))
            if (node.first_child()) profile.sequences.push_back(xml.location(node));
    return profile;
}

} // namespace tandem::command
