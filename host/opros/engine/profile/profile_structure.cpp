// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/profile_structure.hpp"

#include <algorithm>
#include <iterator>
#include <map>

namespace tandem::engine {
namespace {

struct ElementPlace {
    std::string_view name, parent;
};

/// Elements that the engine reads only from this parent.
constexpr ElementPlace places[] = {
    {"property", "properties"},
    {"data_port", "ports"},
    {"event_port", "ports"},
    {"service_port", "ports"},
    {"library_name", "execution_environment"},
    {"period", "execution_semantics"},
    {"phase", "execution_semantics"},
    {"priority", "execution_semantics"},
    {"queue_size", "data_port"},
    {"queueing_policy", "data_port"},
    {"queuing_policy", "data_port"},
    {"subcomponent", "subcomponents"},
    {"port_connection", "port_connections"},
    {"depends", "coordination"},
    {"export_port", "export_ports"},
};

/// These have no other children than those in `places`.
constexpr std::string_view lists[] = {"properties", "ports", "subcomponents", "port_connections",
                                      "export_ports"};

/// The engine reads only the first of these elements, in the root element and in these.
constexpr std::string_view single_parents[] = {
    "execution_environment", "execution_semantics", "data_port",      "event_port",
    "service_port",          "subcomponent",        "port_connection"};
constexpr std::string_view single_elements[] = {"name",
                                                "execution_environment",
                                                "execution_semantics",
                                                "properties",
                                                "ports",
                                                "library_name",
                                                "type",
                                                "period",
                                                "phase",
                                                "priority",
                                                "policy",
                                                "usage",
                                                "data_type",
                                                "queue_size",
                                                "reference",
                                                "source",
                                                "target",
                                                "subcomponents",
                                                "port_connections",
                                                "coordination",
                                                "export_ports",
                                                "queueing_policy",
                                                "queuing_policy"};

constexpr std::string_view number_elements[] = {"phase", "priority", "queue_size"};

template <std::size_t n>
bool contains(const std::string_view (&names)[n], std::string_view name) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

// Limits for files from outside: the engine reads 5 levels, and no user reads more lines.
constexpr int max_depth = 32;
constexpr std::size_t max_errors = 100;

class StructureCheck {
  public:
    explicit StructureCheck(const XmlFile& xml) : xml_(xml) { check_children(xml.root(), 1); }
    std::vector<std::string> errors;

  private:
    void add(const pugi::xml_node& node, const std::string& what) {
        if (errors.size() < max_errors) errors.push_back(xml_.location(node).text() + ": " + what);
    }

    void check_children(const pugi::xml_node& parent, int depth) {
        std::map<std::string, pugi::xml_node> first;
        for (const pugi::xml_node& node : parent.children()) {
            if (node.type() != pugi::node_element) continue;
            check_place(node, parent);
            if (contains(number_elements, node.name())) check_number(node);
            if (std::string_view(node.name()) == "property") check_value(node);
            if (const std::string key = key_of(node); !key.empty())
                if (const auto [known, is_new] = first.try_emplace(key, node); !is_new)
                    add_repeated(node, known->second);
            if (depth < max_depth) check_children(node, depth + 1);
        }
    }

    void check_place(const pugi::xml_node& node, const pugi::xml_node& parent) {
        const auto* const place = std::find_if(std::begin(places), std::end(places),
                                               [&](const auto& each) { return each.name == node.name(); });
        if (place == std::end(places) && contains(lists, parent.name()))
            add(node, tag(node.name()) + " is unknown in " + tag(parent.name()) + ", expected " +
                          children_of(parent));
        if (place != std::end(places) && place->parent != parent.name())
            add(node, tag(node.name()) + " has no effect in " + tag(parent.name()) + "; move it into " +
                          tag(std::string(place->parent).c_str()));
    }

    static std::string children_of(const pugi::xml_node& list) {
        std::string all;
        for (const auto& [name, parent] : places)
            if (parent == list.name()) all += (all.empty() ? "" : " or ") + tag(std::string(name).c_str());
        return all;
    }

    void check_number(const pugi::xml_node& node) {
        if (XmlFile::trim(node.child_value()).empty())
            add(node, tag(node.name()) + " is empty, expected a number; remove it to use the default");
    }

    void check_value(const pugi::xml_node& property) {
        const std::string name = property.attribute("name").value();
        const std::string expected = ", expected <property name=\"" + name + "\">VALUE</property>";
        if (property.attribute("value"))
            add(property, "property " + name + " has its value in the attribute value" + expected);
        for (const pugi::xml_node& child : property.children())
            if (child.type() == pugi::node_element)
                return add(property,
                           "property " + name + " has its value in " + tag(child.name()) + expected);
    }

    /// Returns what may occur once in a parent; empty if the element may be repeated.
    std::string key_of(const pugi::xml_node& node) const {
        std::string element = node.name();
        const bool reads_first =
            node.parent() == xml_.root() || contains(single_parents, node.parent().name());
        if (reads_first && contains(single_elements, element)) return element;
        std::string name;
        if (element == "property") name = XmlFile::trim(node.attribute("name").value());
        if (element.ends_with("_port")) name = XmlFile::child_text(node, "name");
        return name.empty() ? "" : element + " " + name;
    }

    void add_repeated(const pugi::xml_node& node, const pugi::xml_node& first) {
        const std::string key = key_of(node), element = node.name();
        const bool last_counts = element == "property";
        const std::string what = key == element ? tag(node.name()) : "'" + key + "'";
        add(node, what + " is already in line " + std::to_string(xml_.location(first).line) +
                      (last_counts ? "; the last one is used" : "; this one has no effect") + "; remove one");
    }

    const XmlFile& xml_;
};

} // namespace

std::vector<std::string> find_structure_errors(const XmlFile& xml) { return StructureCheck(xml).errors; }

} // namespace tandem::engine
