// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/running/opros_hosts.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/system/running_system.hpp"
#include "host/opros/engine/profile/application_profile.hpp"
#include "host/opros/engine/profile/xml_file.hpp"
#include "host/plugin/plugin_dirs.hpp"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

const std::string* find(const engine::Properties& properties, const std::string& name) {
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [&](const auto& each) { return each.first == name; });
    return found == properties.end() ? nullptr : &found->second;
}

void set_property(pugi::xml_node component, const std::string& name, const std::string& value) {
    auto properties = component.child("properties");
    if (!properties) properties = component.append_child("properties");
    auto property = properties.find_child_by_attribute("property", "name", name.c_str());
    if (!property) {
        property = properties.append_child("property");
        property.append_attribute("name") = name.c_str();
    }
    property.text().set(value.c_str());
}

/// Writes the values of the profile's properties that differ from those with which the component started.
void save_properties(pugi::xml_node node, const engine::Subcomponent& component,
                     const engine::ComponentProfile& profile, const nlohmann::json& values) {
    for (const auto& [name, value] : values.items()) {
        if (!value.is_string()) continue;
        const std::string* before = find(component.properties, name);
        if (before == nullptr) before = find(profile.properties, name);
        if (before != nullptr && *before != value.get<std::string>())
            set_property(node, name, value.get<std::string>());
    }
}

} // namespace

std::vector<std::string> save_opros(const RunningSystem& system, const fs::path& output) {
    const engine::XmlFile xml(system.application);
    const auto application = engine::read_application_profile(xml);
    const OprosClientOptions options;
    std::vector<std::string> left_out;
    pugi::xml_document document;
    auto declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "UTF-8";
    auto list = document.append_copy(xml.root()).child("subcomponents");
    for (auto node : list.children("subcomponent")) {
        const std::string name = engine::XmlFile::child_text(node, "name");
        const auto component =
            std::find_if(application.subcomponents.begin(), application.subcomponents.end(),
                         [&](const auto& each) { return each.name == name; });
        if (component == application.subcomponents.end()) continue;
        try {
            const fs::path file =
                engine::find_component_profile(application, *component, plugin::default_plugin_dirs("opros"));
            node.child("reference")
                .text()
                .set(file.parent_path() == system.application.parent_path() ? file.filename().c_str()
                                                                            : file.c_str());
            const auto running = find_running_component(options, fmt::format("{}/{}", system.opros, name));
            const auto reply = request_component(options, running, "conf");
            save_properties(node, *component, engine::read_component_profile(file), reply.at("properties"));
        } catch (const std::exception&
                     error) { // a composite, left out by the host, or an answer without properties
            left_out.push_back("properties of " + name + ": " + error.what());
        }
    }
    std::ostringstream text;
    document.save(text, "  ");
    write_file(output / "opros" / system.application.filename(), text.str());
    return left_out;
}

} // namespace tandem::command
