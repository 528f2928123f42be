// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/probe_tasks.hpp"

#include "host/opros/control/describe_port.hpp"
#include "host/opros/engine/connect/make_connection.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/load/absent_properties.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/node/node_part.hpp"
#include "proxy/adaptor/archive/type_check.hpp"

#include <Component.h>
#include <algorithm>
#include <chrono>
#include <dlfcn.h>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

namespace tandem::command {
namespace {

using nlohmann::json;

// Returns null if the type cannot cross a link, or if its own load() rejects a trial's values.
json signature_of(const opros_any& sample) {
    try {
        return wire::to_signature(adaptor::type_of(sample, {}));
    } catch (const std::exception&) {
        return nullptr;
    }
}

// Data and event ports also have the signature of their type on a link.
json describe_port_and_type(Port& port) {
    json out = control::describe_port(port);
    if (out["kind"] == "service") return out;
    const opros_any sample = port.sample();
    if (sample.serializable()) out["signature"] = signature_of(sample);
    return out;
}

/// Returns {"properties": {name: value}, "ports": [{"name", "kind": data|event|service, "direction":
/// input|output|provided|required, "type", "signature", "methods": [{"name", "signature", "call"}]}]}. "type" is null
/// if the port carries any type. "signature" describes the data on a link; null if they cannot cross a link. Only
/// services have "methods". Runs the component's code. [child process]
json describe_component(Component& component) {
    json ports = json::array();
    for (const PortType kind : {OPROS_DATA, OPROS_EVENT, OPROS_SERVICE})
        for (const std::string& name : component.getPortNames(kind)) {
            json port = describe_port_and_type(*component.getPort(name));
            port["name"] = name;
            ports.push_back(std::move(port));
        }
    return {{"properties", component.getPropertyMap()}, {"ports", std::move(ports)}};
}

using nlohmann::json;

// The child process runs this program itself, see serve_probe() in main.cpp.
plugin::ProbeOptions make_probe(const InspectOptions& options, const char* subject) {
    plugin::ProbeOptions probe;
    probe.timeout = std::chrono::milliseconds(static_cast<long>(options.timeout_s * 1000));
    probe.subject = subject;
    return probe;
}

// Passes one JSON text, so that names may contain any character.
json make_request(const InspectOptions& options) {
    json request{{"initialize", options.initialize}, {"node", options.node}, {"plugin_dirs", json::array()}};
    for (const auto& dir : options.plugin_dirs) request["plugin_dirs"].push_back(dir.string());
    return request;
}

// The reverse of make_request(). [child process]
std::vector<std::filesystem::path> plugin_dirs(const json& request) {
    std::vector<std::filesystem::path> dirs;
    for (const auto& dir : request["plugin_dirs"]) dirs.emplace_back(dir.get<std::string>());
    return dirs;
}

// Does what opros_host does before it connects ports.
void initialize_and_report(Component& component, const std::string& name, plugin::ProbeReport& report) {
    report.begin_stage("onInitialize() of " + name);
    // Device components call dlerror() after their dlsym(). This clears errors of earlier code.
    dlerror();
    if (component.initialize() != OPROS_SUCCESS)
        throw engine::SetupError("onInitialize() of " + name + " failed with code " +
                                 std::to_string(component.getErrorInfo()));
}

using Components = std::map<std::string, std::unique_ptr<engine::ComponentHost>>;

Components create_components(engine::ApplicationProfile& profile, const json& request,
                             plugin::ProbeReport& report) {
    const auto excluded = request["excluded"].get<std::vector<std::string>>();
    const auto port_tables = request["port_tables"].get<std::map<std::string, std::string>>();
    const auto dirs = plugin_dirs(request);
    Components components;
    for (auto& entry : profile.subcomponents) {
        if (std::find(excluded.begin(), excluded.end(), entry.name) != excluded.end()) continue;
        report.begin_stage("the constructor of component " + entry.name);
        auto search = dirs;
        search.insert(search.begin(), profile.location.file.parent_path());
        const auto mirrored = port_tables.find(entry.name);
        if (mirrored != port_tables.end()) entry.properties.emplace_back("port_table", mirrored->second);
        auto component = std::make_unique<engine::ComponentHost>(
            entry,
            engine::read_component_profile(
                entry.file.empty() ? engine::find_component_profile(profile, entry, dirs) : entry.file),
            engine::ComponentHostOptions{search, nullptr, 1, engine::TaskQueue::Mode::in_caller});
        // AdaptorComp creates its ports in onInitialize.
        if (request["initialize"] || mirrored != port_tables.end())
            initialize_and_report(component->component(), entry.name, report);
        components.emplace(entry.name, std::move(component));
    }
    return components;
}

std::vector<std::string> make_connections(const engine::ApplicationProfile& profile,
                                          const Components& components, plugin::ProbeReport& report) {
    std::vector<std::string> errors;
    std::vector<std::unique_ptr<engine::Connection>> connections;
    for (const auto& connection : profile.connections) {
        if (!connection.error.empty()) continue; // opros_check() reports it
        const auto source = components.find(connection.source.component),
                   target = components.find(connection.target.component);
        if (source == components.end() || target == components.end()) continue;
        report.begin_stage("the connection at line " + std::to_string(connection.location.line));
        try {
            connections.push_back(engine::make_connection(connection, *source->second, *target->second));
        } catch (const engine::SetupError& error) {
            errors.emplace_back(error.what());
        }
    }
    return errors;
}

// Removes the location from the message, because these connections are in no file.
std::string try_connection(const engine::ConnectionProfile& connection, const Components& components) {
    try {
        engine::make_connection(connection, *components.at(connection.source.component),
                                *components.at(connection.target.component));
        return "";
    } catch (const engine::SetupError& error) {
        const std::string text = error.what(), location = connection.location.text() + ": ";
        return text.rfind(location, 0) == 0 ? text.substr(location.size()) : text;
    }
}

std::vector<std::string> try_connections(const json& trials, const Components& components,
                                         plugin::ProbeReport& report) {
    std::vector<std::string> errors;
    for (const auto& trial : trials) {
        engine::ConnectionProfile connection;
        connection.type = trial["type"].get<PortType>();
        connection.source = {trial["source"][0], trial["source"][1]};
        connection.target = {trial["target"][0], trial["target"][1]};
        report.begin_stage("the connection of " + connection.source.text() + " with " +
                           connection.target.text());
        errors.push_back(try_connection(connection, components));
    }
    return errors;
}

} // namespace

json describe_in_child(const std::filesystem::path& library, const std::filesystem::path& profile,
                       const InspectOptions& options) {
    json request = make_request(options);
    // Passes the file instead of its content, so that the child reads it and resolves relative references as the host
    // does.
    request["profile"] = profile.string();
    return json::parse(
        plugin::run_probe(make_probe(options, "library"), describe_task, library, {request.dump()}));
}

std::vector<std::string> check_connections_in_child(const std::vector<std::string>& excluded,
                                                    const std::map<std::string, std::string>& port_tables,
                                                    const InspectOptions& options) {
    json request = make_request(options);
    request["excluded"] = excluded;
    request["port_tables"] = port_tables;
    return json::parse(
        plugin::run_probe(make_probe(options, "application"), connect_task, options.file, {request.dump()}));
}

std::vector<std::string> try_connections_in_child(const std::vector<TrialConnection>& trials,
                                                  const std::vector<std::string>& excluded,
                                                  const std::map<std::string, std::string>& port_tables,
                                                  const InspectOptions& options) {
    json request = make_request(options);
    request["excluded"] = excluded;
    request["port_tables"] = port_tables;
    request["trials"] = json::array();
    for (const auto& trial : trials)
        request["trials"].push_back({{"type", trial.type},
                                     {"source", {trial.source.component, trial.source.port}},
                                     {"target", {trial.target.component, trial.target.port}}});
    return json::parse(
        plugin::run_probe(make_probe(options, "application"), connect_task, options.file, {request.dump()}));
}

// Names each stage before it runs code of the component, so that the parent can report where the child died.
void serve_describe(const plugin::ProbeTask& task, plugin::ProbeReport& report) {
    const json request = json::parse(task.arguments.at(0));
    report.begin_stage("its static constructors");
    const auto library = plugin::Library::load(task.library);
    report.begin_stage("getComponent()");
    const auto loaded = engine::instantiate_component(task.library);
    if (const std::string file = request["profile"]; !file.empty()) {
        const auto profile = engine::read_component_profile(file);
        loaded.component->setId(profile.name);
        engine::set_component_properties(*loaded.component, profile, {}, plugin_dirs(request));
    }
    engine::watch_absent_properties(false);
    if (request["initialize"]) initialize_and_report(*loaded.component, task.library, report);
    report.begin_stage("its ports");
    json description = describe_component(*loaded.component);
    // The host sets these properties for the component. They are not in the profile.
    for (const char* name : engine::folder_property_names) description["properties"].erase(name);
    description["absent_properties"] = json::array();
    for (const auto& absent : engine::absent_properties())
        description["absent_properties"].push_back(
            {{"name", absent.name}, {"misspelt", absent.misspelt}, {"line", absent.line}});
    if (library->has("getVersion")) {
        report.begin_stage("getVersion()");
        description["version"] = library->symbol<const char*()>("getVersion")();
    }
    report.finish(description.dump(-1, ' ', false, json::error_handler_t::replace));
}

// Creates and connects the components as opros_host would, but does not start them.
void serve_connect(const plugin::ProbeTask& task, plugin::ProbeReport& report) {
    const json request = json::parse(task.arguments.at(0));
    const auto dirs = plugin_dirs(request);
    auto profile =
        engine::local_application(engine::read_application_profile(task.library), dirs, request["node"]);
    const Components components = create_components(profile, request, report);
    const auto errors = request.contains("trials") ? try_connections(request["trials"], components, report)
                                                   : make_connections(profile, components, report);
    report.finish(json(errors).dump(-1, ' ', false, json::error_handler_t::replace));
}

plugin::ProbeTasks opros_probe_tasks() {
    return {{describe_task, serve_describe}, {connect_task, serve_connect}};
}

} // namespace tandem::command
