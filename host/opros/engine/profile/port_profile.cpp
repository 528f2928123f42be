// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/port_profile.hpp"

namespace tandem::engine {
namespace {

/// The policy stands in an element of one of these names.
constexpr const char* policy_names[] = {"queueing_policy", "queuing_policy", "policy"};

pugi::xml_node policy_node(const pugi::xml_node& port) {
    for (const char* name : policy_names)
        if (!XmlFile::child_text(port, name).empty()) return port.child(name);
    return {};
}

DataPortPolicy policy_of(const XmlFile& xml, const pugi::xml_node& node) {
    const std::string policy = XmlFile::keyword(node.child_value());
    if (policy == "fifo") return OPROS_FIFO;
    if (policy == "lifo") return OPROS_LIFO;
    if (policy == "ufifo") return OPROS_UFIFO;
    if (policy == "last") return OPROS_LAST;
    xml.fail(node, std::string("<") + node.name() + "> is '" + XmlFile::trim(node.child_value()) +
                       "', expected FIFO, LIFO, UFIFO or LAST");
}

/// `<queue_size>10</queue_size>` or, with `<policy>`, `<policy_param name="size">10</policy_param>`.
pugi::xml_node size_node(const pugi::xml_node& port) {
    for (const pugi::xml_node& parameter : port.children("policy_param"))
        if (std::string(parameter.attribute("name").value()) == "size") return parameter;
    return port.child("queue_size");
}

std::optional<QueueProfile> queue_of(const XmlFile& xml, const pugi::xml_node& port) {
    const pugi::xml_node policy = policy_node(port), size = size_node(port);
    const double wanted = xml.number(size, DEFAULT_QUEUE_LIMIT);
    if (wanted < 1 || wanted > max_queue_size)
        xml.fail(size, "a queue has 1 to " + std::to_string(max_queue_size) + " places, got '" +
                           XmlFile::trim(size.child_value()) + "'");
    if (!policy && !size) return std::nullopt;
    return QueueProfile{policy ? policy_of(xml, policy) : OPROS_FIFO, static_cast<unsigned int>(wanted)};
}

std::string usage_of(const pugi::xml_node& port) {
    return XmlFile::keyword(port.child("usage").child_value());
}

/// Those of real profiles that are none (`output1`) are left out, as by the original engine.
bool listed(const XmlFile& xml, const pugi::xml_node& port, const char* one, const char* other,
            ComponentProfile& profile) {
    const std::string name = XmlFile::child_text(port, "name"), usage = usage_of(port);
    const std::string place = xml.location(port).text() + ": <" + port.name() + "> ";
    if (name.empty())
        profile.port_errors.push_back(place + "lacks its <name>");
    else if (usage != one && usage != other)
        profile.port_errors.push_back(place + "'" + name + "' has the <usage> '" +
                                      XmlFile::child_text(port, "usage") + "', expected " + one + " or " +
                                      other);
    else
        return true;
    return false;
}

} // namespace

void read_ports(const XmlFile& xml, const pugi::xml_node& ports, ComponentProfile& profile) {
    for (const pugi::xml_node& port : ports.children("data_port")) {
        if (!listed(xml, port, "input", "output", profile)) continue;
        const bool input = usage_of(port) == "input";
        profile.data_ports.push_back({xml.location(port), XmlFile::child_text(port, "name"),
                                      XmlFile::child_text(port, "data_type"), input,
                                      input ? queue_of(xml, port) : std::nullopt});
    }
    for (const pugi::xml_node& port : ports.children("event_port"))
        if (listed(xml, port, "input", "output", profile))
            profile.event_ports.push_back({xml.location(port), XmlFile::child_text(port, "name"),
                                           XmlFile::child_text(port, "data_type"),
                                           usage_of(port) == "input"});
    for (const pugi::xml_node& port : ports.children("service_port"))
        if (listed(xml, port, "provided", "required", profile))
            profile.service_ports.push_back(
                {xml.location(port), XmlFile::child_text(port, "name"), XmlFile::child_text(port, "type"),
                 XmlFile::child_text(port, "reference"), usage_of(port) == "provided"});
}

} // namespace tandem::engine
