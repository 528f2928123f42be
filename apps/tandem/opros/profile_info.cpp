// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/profile_info.hpp"

#include "apps/tandem/opros/ports_text.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/text.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "host/opros/engine/profile/type_profile.hpp"

#include <fmt/format.h>
#include <map>

namespace tandem::command {
namespace {

using engine::ApplicationProfile;
using nlohmann::json;

json components_of(const ApplicationProfile& profile) {
    json components = json::array();
    for (const auto& entry : profile.subcomponents)
        components.push_back({{"name", entry.name}, {"profile", entry.reference}});
    return components;
}

const char* word(PortType type) {
    if (type == OPROS_DATA) return "data";
    return type == OPROS_EVENT ? "event" : "service";
}

json application_info(const ApplicationProfile& profile) {
    json connections = json::array();
    for (const auto& each : profile.connections)
        connections.push_back(
            {{"kind", word(each.type)}, {"from", each.source.text()}, {"to", each.target.text()}});
    return {{"kind", "application"},
            {"name", profile.name},
            {"components", components_of(profile)},
            {"connections", connections}};
}

/// The ports that a composite exports, as the code of its components has them, whatever its depth.
class ExportedPorts {
  public:
    ExportedPorts(const ApplicationProfile& composite, const LookOptions& options)
        : composite_(composite), options_(options) {}

    json all() {
        json ports = json::array();
        for (const auto& each : composite_.exports) ports.push_back(described_port(each));
        return ports;
    }

  private:
    json described_port(const engine::ExportedPort& exported) {
        ApplicationProfile one = composite_; // with a connection that goes where the port leads
        one.connections = {{exported.location, exported.type, exported.port, exported.port, ""}};
        const auto flat = engine::flatten_composites(one, options_.plugin_dirs);
        const engine::ConnectionProfile& leads = flat.connections.front();
        if (!leads.error.empty()) throw engine::SetupError(exported.location, leads.error);
        for (const auto& entry : flat.subcomponents)
            if (entry.name == leads.source.component)
                for (json port : ports_of(entry))
                    if (port["name"] == leads.source.port && port["kind"] == word(exported.type)) {
                        port["name"] = exported.name;
                        port["of"] = leads.source.text();
                        return port;
                    }
        throw engine::SetupError(exported.location, "component '" + leads.source.component + "' has no " +
                                                        word(exported.type) + " port '" + leads.source.port +
                                                        "'");
    }

    const json& ports_of(const engine::Subcomponent& entry) {
        const auto [known, is_new] = ports_.try_emplace(entry.name);
        if (is_new) {
            const auto profile = engine::read_component_profile(entry.file);
            auto dirs = options_.plugin_dirs;
            dirs.insert(dirs.begin(), composite_.location.file.parent_path());
            const auto library = engine::find_component_library(profile, dirs);
            engine::require_opros_component(library);
            known->second = described(library, entry.file, options_)["ports"];
        }
        return known->second;
    }

    const ApplicationProfile& composite_;
    const LookOptions& options_;
    std::map<std::string, json> ports_;
};

json composite_info(const ApplicationProfile& profile, const LookOptions& options) {
    return {{"kind", "composite"},
            {"name", profile.name},
            {"components", components_of(profile)},
            {"ports", ExportedPorts(profile, options).all()}};
}

json service_types_info(const std::filesystem::path& file) {
    json types = json::array();
    for (const auto& type : engine::read_service_type_profile(file)) {
        json methods = json::array();
        for (const auto& method : type.methods) {
            std::string parameters;
            for (const auto& each : method.parameters)
                parameters +=
                    (parameters.empty() ? "" : ", ") + each.type + (each.name.empty() ? "" : " " + each.name);
            methods.push_back({{"name", method.name},
                               {"signature", method.return_type + " (" + parameters + ")"},
                               {"call", method.call_type}});
        }
        types.push_back({{"name", type.name}, {"methods", methods}});
    }
    return {{"kind", "service type"}, {"types", types}};
}

json data_types_info(const std::filesystem::path& file) {
    json types = json::array();
    for (const auto& type : engine::read_data_type_profile(file)) {
        json fields = json::array();
        for (const auto& field : type.fields)
            fields.push_back({{"name", field.name}, {"type", field.type}, {"default", field.default_value}});
        types.push_back({{"name", type.name}, {"fields", fields}});
    }
    return {{"kind", "data type"}, {"types", types}};
}

std::string text_at(const json& object, const char* key) {
    return in_one_line(object.at(key).get<std::string>());
}

std::string assembly_text(const json& info) {
    Table components({"component", "profile"});
    for (const json& each : info["components"])
        components.add({text_at(each, "name"), text_at(each, "profile")});
    std::string text = "\n" + components.text();
    if (info.contains("ports")) return text + "\n" + ports_text(info["ports"]);
    Table connections({"connection", "from", "to"});
    for (const json& each : info["connections"])
        connections.add({text_at(each, "kind"), text_at(each, "from"), text_at(each, "to")});
    return text + "\n" + (connections.empty() ? "no connections\n" : connections.text());
}

std::string types_text(const json& info) {
    std::string text;
    for (const json& type : info["types"]) {
        const bool is_service = type.contains("methods");
        Table table({is_service ? "method" : "field", is_service ? "signature" : "type",
                     is_service ? "call" : "default"});
        for (const json& each : type[is_service ? "methods" : "fields"])
            table.add({text_at(each, "name"), text_at(each, is_service ? "signature" : "type"),
                       text_at(each, is_service ? "call" : "default")});
        text += "\n" + text_at(type, "name") + "\n" + table.text();
    }
    return text;
}

} // namespace

json profile_info(engine::ProfileKind kind, const LookOptions& options) {
    json info;
    if (kind == engine::ProfileKind::application)
        info = application_info(engine::read_application_profile(options.file));
    else if (kind == engine::ProfileKind::composite)
        info = composite_info(engine::read_composite_profile(options.file), options);
    else if (kind == engine::ProfileKind::service_type)
        info = service_types_info(options.file);
    else
        info = data_types_info(options.file);
    info["profile"] = std::filesystem::absolute(options.file).lexically_normal().string();
    return info;
}

std::string profile_text(const json& info) {
    const std::string kind = text_at(info, "kind");
    const bool is_assembly = info.contains("components");
    return fmt::format("{:<11}  {}\nprofile      {}\n", kind, is_assembly ? text_at(info, "name") : "",
                       text_at(info, "profile")) +
           (is_assembly ? assembly_text(info) : types_text(info));
}

} // namespace tandem::command
