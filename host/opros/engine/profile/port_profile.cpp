// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/port_profile.hpp"

#include "host/opros/engine/profile/component_profile.hpp"

namespace tandem::engine {
namespace {

/// Three spellings of the same element: OPRoS v1.1, OPRoS v1, and hand-written profiles.
constexpr const char* queue_policy_elements[] = {"queueing_policy", "queuing_policy", "policy"};

pugi::xml_node find_queue_policy(const pugi::xml_node& port) {
    for (const char* name : queue_policy_elements)
        if (!XmlFile::child_text(port, name).empty()) return port.child(name);
    return {};
}

DataPortPolicy parse_queue_policy(const XmlFile& xml, const pugi::xml_node& node) {
    const std::string policy = XmlFile::keyword(node.child_value());
    if (policy == "fifo") return OPROS_FIFO;
    if (policy == "lifo") return OPROS_LIFO;
    if (policy == "ufifo") return OPROS_UFIFO;
    if (policy == "last") return OPROS_LAST;
    xml.fail(node, std::string("<") + node.name() + "> is '" + XmlFile::trim(node.child_value()) +
                       "', expected FIFO, LIFO, UFIFO or LAST");
}

/// `<queue_size>10</queue_size>` or, with `<policy>`, `<policy_param name="size">10</policy_param>`.
pugi::xml_node find_queue_size(const pugi::xml_node& port) {
    for (const pugi::xml_node& parameter : port.children("policy_param"))
        if (std::string(parameter.attribute("name").value()) == "size") return parameter;
    return port.child("queue_size");
}

std::optional<QueueProfile> read_queue_profile(const XmlFile& xml, const pugi::xml_node& port) {
    const pugi::xml_node policy = find_queue_policy(port), size = find_queue_size(port);
    const double limit = xml.number(size, DEFAULT_QUEUE_LIMIT);
    if (limit < 1 || limit > max_queue_size)
        xml.fail(size, "a queue has 1 to " + std::to_string(max_queue_size) + " places, got '" +
                           XmlFile::trim(size.child_value()) + "'");
    if (!policy && !size) return std::nullopt;
    return QueueProfile{policy ? parse_queue_policy(xml, policy) : OPROS_FIFO,
                        static_cast<unsigned int>(limit)};
}

std::string port_usage(const pugi::xml_node& port) {
    return XmlFile::keyword(port.child("usage").child_value());
}

/// Returns true if the port has a name and one of the two usages. Otherwise adds a line to `port_errors`.
bool check_port(const XmlFile& xml, const pugi::xml_node& port, const char* first_usage,
                const char* second_usage, ComponentProfile& profile) {
    const std::string name = XmlFile::child_text(port, "name"), usage = port_usage(port);
    const std::string prefix = xml.location(port).text() + ": <" + port.name() + "> ";
    if (name.empty()) {
        profile.port_errors.push_back(prefix + "lacks its <name>");
        return false;
    }
    if (usage == first_usage || usage == second_usage) return true;
    profile.port_errors.push_back(prefix + "'" + name + "' has the <usage> '" +
                                  XmlFile::child_text(port, "usage") + "', expected " + first_usage + " or " +
                                  second_usage);
    return false;
}

} // namespace

void read_port_profiles(const XmlFile& xml, const pugi::xml_node& ports, ComponentProfile& profile) {
    for (const pugi::xml_node& port : ports.children("data_port")) {
        if (!check_port(xml, port, "input", "output", profile)) continue;
        const bool is_input = port_usage(port) == "input";
        profile.data_ports.push_back({xml.location(port), XmlFile::child_text(port, "name"),
                                      XmlFile::child_text(port, "data_type"), is_input,
                                      is_input ? read_queue_profile(xml, port) : std::nullopt});
    }
    for (const pugi::xml_node& port : ports.children("event_port"))
        if (check_port(xml, port, "input", "output", profile))
            profile.event_ports.push_back({xml.location(port), XmlFile::child_text(port, "name"),
                                           XmlFile::child_text(port, "data_type"),
                                           port_usage(port) == "input"});
    for (const pugi::xml_node& port : ports.children("service_port"))
        if (check_port(xml, port, "provided", "required", profile))
            profile.service_ports.push_back(
                {xml.location(port), XmlFile::child_text(port, "name"), XmlFile::child_text(port, "type"),
                 XmlFile::child_text(port, "reference"), port_usage(port) == "provided"});
}

} // namespace tandem::engine
