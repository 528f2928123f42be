// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/import/component_differences.hpp"

#include "apps/tandem/build/folder/source_text.hpp"

#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/load/plugin_dirs.hpp"
#include "host/opros/engine/profile/xml_file.hpp"
#include "host/plugin/error.hpp"
#include "host/plugin/find_library.hpp"

#include <algorithm>
#include <set>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using engine::XmlFile;

bool is_periodic(const engine::ComponentProfile& profile) {
    return profile.execution_type == engine::ExecutionType::periodic ||
           profile.execution_type == engine::ExecutionType::periodic_shared;
}

void tell_execution(const XmlFile& xml, const engine::ComponentProfile& profile, ImportReport& report) {
    const auto semantics = xml.root().child("execution_semantics");
    const auto differs = [&](const pugi::xml_node& node, const std::string& what, const char* here) {
        report.add_difference(xml.location(node).text(), profile.name + ": " + what, here);
    };
    if (profile.execution_type == engine::ExecutionType::aperiodic)
        differs(semantics.child("type"), "execution type " + XmlFile::child_text(semantics, "type"),
                "runs when an input has arrived, not continuously; for the engine's behaviour, use "
                "aperiodic-loop");
    if (is_periodic(profile) && profile.scheduling_policy == engine::SchedulingPolicy::other)
        differs(semantics.child("type"), "a periodic component",
                "has no real-time priority, which the engine, as root, would set; to use <priority>, set "
                "<policy>SCHED_FIFO</policy>");
}

void tell_queues(const engine::ComponentProfile& profile, ImportReport& report) {
    for (const auto& port : profile.data_ports)
        if (port.queue)
            report.add_difference(
                port.location.text(),
                profile.name + ": queue of port " + port.name + " for " + std::to_string(port.queue->size) +
                    " values",
                "takes effect if the component's code sets no queue for the port; the engine ignores it");
    for (const auto& error : profile.port_errors)
        report.add_difference(profile.location.text(), profile.name, error);
}

bool has_component_source(const fs::path& folder) {
    for (const auto& place : {folder, folder / "src"})
        for (const auto& file : list_files(place))
            if (is_source(file) && defines_function(strip_comments(read_text(file)), "getComponent"))
                return true;
    return false;
}

// Returns a folder of sources in the installation whose name begins with the component's name.
fs::path find_component_sources(const fs::path& engine_dir, const std::string& name) {
    constexpr int max_depth = 4, max_seen = 5000;
    int seen = 0;
    std::error_code ignored; // unreadable folders count as empty
    for (auto entry = fs::recursive_directory_iterator(
             engine_dir, fs::directory_options::skip_permission_denied, ignored);
         entry != fs::recursive_directory_iterator() && ++seen < max_seen; entry.increment(ignored)) {
        if (entry.depth() >= max_depth) entry.disable_recursion_pending();
        if (entry->is_directory(ignored) && entry->path().filename().string().starts_with(name) &&
            has_component_source(entry->path()))
            return entry->path();
    }
    return {};
}

// Returns the original of a copied folder, or of a folder in it.
fs::path old_place(const fs::path& folder, const ComponentPlaces& places) {
    for (const auto& [copy, original] : places.folders)
        if (const fs::path below = folder.lexically_relative(copy); !below.empty() && *below.begin() != "..")
            return (original / below).lexically_normal();
    return folder;
}

// Returns the library in the installation if opros_host can load it; otherwise sets `why` to the reason.
fs::path find_usable_library(const engine::ComponentProfile& profile, const ComponentPlaces& places,
                             const fs::path& old_folder, std::string& why) {
    std::vector<fs::path> folders{old_folder, places.application.location.file.parent_path()};
    try {
        fs::path library = plugin::find_library(profile.library_name, folders);
        engine::require_opros_component(library);
        return library;
    } catch (const plugin::Error& error) {
        why = error.reason() == plugin::Reason::not_found      ? "its library was not found"
              : error.reason() == plugin::Reason::abi_mismatch ? "its library was built for another engine"
                                                               : error.what();
        return {};
    }
}

void import_library(const engine::ComponentProfile& profile, const ComponentPlaces& places,
                    ImportReport& report) {
    const fs::path folder = profile.location.file.parent_path();
    std::string why;
    const fs::path library = find_usable_library(profile, places, old_place(folder, places), why);
    if (!library.empty()) {
        fs::copy_file(library, folder / library.filename(), fs::copy_options::skip_existing);
        return;
    }
    const fs::path sources = find_component_sources(places.engine_dir, profile.name);
    report.add_task(profile.library_location.text(), "component " + profile.name + ": " + why,
                    "tandem opros build " + (sources.empty() ? "FOLDER_OF_ITS_SOURCE" : sources.string()) +
                        " --profile " + profile.location.file.string());
}

} // namespace

void tell_application_differences(const engine::ApplicationProfile& application, const EngineConfig& config,
                                  ImportReport& report) {
    const XmlFile xml(application.location.file);
    std::string local = config.node_id;
    for (const auto& node : xml.root().child("subcomponents").children("subcomponent")) {
        const std::string id = XmlFile::child_text(node, "node_id"), name = XmlFile::child_text(node, "name");
        if (local.empty())
            local = id; // without system.xml, the first component's node_id counts as the engine's own
        if (!id.empty() && id != local)
            report.add_difference(xml.location(node.child("node_id")).text(), name + ": node_id " + id,
                                  "runs in this host; the engine calls it at that node by TCP");
        if (node.child("properties"))
            report.add_difference(
                xml.location(node.child("properties")).text(), name + ": properties",
                "override the properties of the component profile; the engine ignores them");
    }
    for (const auto& connection : application.connections)
        if (!connection.error.empty())
            report.add_difference(connection.location.text(),
                                  connection.source.text() + " to " + connection.target.text(),
                                  "left out with a message: " + connection.error);
    report.add_difference(application.location.file.string(), "a component that fails",
                          "loses its connections, and the others run; the engine refuses the application, as "
                          "tandem run --strict does");
}

void import_component(const engine::Subcomponent& component, const ComponentPlaces& places,
                      ImportReport& report) {
    const XmlFile xml(component.file);
    engine::ComponentProfile profile;
    try {
        profile = engine::read_component_profile(xml);
    } catch (
        const engine::SetupError&
            error) { // the engine accepts some invalid profiles, such as a periodic component without a period
        return report.add_task("", error.what(), "edit the profile");
    }
    import_library(profile, places, report);
    tell_execution(xml, profile, report);
    tell_queues(profile, report);
    auto folders = engine::default_plugin_dirs();
    for (const auto& line : engine::check_properties(profile, component.properties, folders))
        report.add_task("", line, "");
}

} // namespace tandem::command
