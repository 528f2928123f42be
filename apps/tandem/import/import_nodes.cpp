// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/import/import_nodes.hpp"

#include "host/opros/engine/profile/xml_file.hpp"

#include <algorithm>
#include <set>

namespace tandem::command {
namespace {

void add_text(pugi::xml_node parent, const char* name, const std::string& text) {
    parent.append_child(name).text().set(text.c_str());
}

} // namespace

bool ImportNodes::has_elsewhere() const {
    return std::any_of(application_.subcomponents.begin(), application_.subcomponents.end(),
                       [this](const auto& component) { return is_elsewhere(component); });
}

void ImportNodes::write(pugi::xml_node root) const {
    if (!has_elsewhere()) return;
    for (auto component : root.child("subcomponents").children("subcomponent"))
        if (engine::XmlFile::child_text(component, "node_id").empty()) {
            component.remove_child("node_id");
            add_text(component, "node_id", config_.node_id);
        }
    add_text(root, "local_node_id", config_.node_id);
    auto map = root.append_child("node_map");
    for (const auto& [id, address] : config_.addresses) {
        auto node = map.append_child("node");
        node.append_attribute("id") = id.c_str();
        auto prop = node.append_child("prop");
        prop.append_attribute("name") = "ip.addr";
        prop.text().set(address.c_str());
    }
}

void ImportNodes::report(const engine::ApplicationProfile& written, ImportReport& report) const {
    std::set<std::string> others;
    for (const auto& component : application_.subcomponents)
        if (component.node != config_.node_id && !component.node.empty()) others.insert(component.node);
    if (config_.node_id.empty() && others.size() > 1)
        report.add_task(written.location.text(),
                        "the components run on several nodes, and no system.xml with a local_node_id says "
                        "which is this one",
                        "tandem run --node " + *others.begin());
    if (!has_elsewhere()) return;
    for (const auto& component : written.subcomponents)
        if (is_elsewhere(component))
            report.add_difference(component.location.text(), component.name + ": node_id " + component.node,
                                  "does not run here; tandem run connects it by CORBA instead of TCP");
    others.insert(config_.node_id);
    for (const auto& id : others)
        if (config_.addresses.count(id) == 0)
            report.add_task(written.location.text(), "<node_map> has no address of node " + id,
                            "add <node id=\"" + id + "\"><prop name=\"ip.addr\">ADDRESS</prop></node>");
}

} // namespace tandem::command
