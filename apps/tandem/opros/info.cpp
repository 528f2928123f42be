// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/description/executor_format.hpp"
#include "apps/tandem/opros/description/port_format.hpp"
#include "apps/tandem/opros/description/profile_description.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/plugin/find_library.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace tandem::command {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// The library of a component and, if there is one, its profile.
struct InspectedComponent {
    fs::path library;
    std::optional<engine::ComponentProfile> profile;
    std::string unreadable; ///< without a profile: the error of a file beside the library that may be it
};

// Whether the profile names this library, in any of the spellings that the host accepts.
bool refers_to(const engine::ComponentProfile& profile, const fs::path& library) {
    const auto candidates = plugin::library_file_names(profile.library_name);
    return std::find(candidates.begin(), candidates.end(), library.filename().string()) != candidates.end();
}

// With the component profile in the library's folder that names the library, if there is one.
InspectedComponent find_profile_beside(const fs::path& library) {
    InspectedComponent found{library, std::nullopt, ""};
    for (const auto& file : list_entries(fs::absolute(library).parent_path(), ".xml")) {
        try {
            if (engine::find_profile_kind(file) != engine::ProfileKind::component) continue;
            auto profile = engine::read_component_profile(file);
            if (refers_to(profile, library)) return {library, std::move(profile), ""};
        } catch (const engine::SetupError& error) {
            if (found.unreadable.empty()) found.unreadable = error.what();
        }
    }
    return found;
}

// FILE is either a profile, whose library is searched for, or a library, whose profile may lie beside it.
// With a library given, a profile with errors is a note: the library can be shown without it.
InspectedComponent find_component(const InspectOptions& options) {
    if (options.file.empty())
        throw std::runtime_error("FILE is empty: expected a component library or profile");
    // The extension tells them apart: libraries may have any other.
    if (options.file.extension() != ".xml") return find_profile_beside(options.file);
    auto profile = engine::read_component_profile(options.file);
    return {engine::find_component_library(profile, options.plugin_dirs), std::move(profile), ""};
}

// Of the profile: a library alone does not know how it is to be run.
json describe_executor(const engine::ComponentProfile& profile) {
    return {{"type", to_string(profile.execution_type)},
            {"period_ms", static_cast<double>(profile.period.count()) / 1e6},
            {"phase_ms", static_cast<double>(profile.phase.count()) / 1e6},
            {"priority", profile.priority}};
}

// Loads the library in a child process, after a look at its file: that tells of wrong kinds without running anything.
json inspect(const InspectedComponent& found, const InspectOptions& options) {
    engine::require_opros_component(found.library);
    json info =
        describe_in_child(found.library, found.profile ? found.profile->location.file : fs::path(), options);
    // Absolute paths: the JSON may be read in another folder. null for what only a profile knows.
    info["library"] = fs::absolute(found.library).lexically_normal().string();
    info["name"] = found.profile ? found.profile->name : found.library.stem().string();
    info["profile"] =
        found.profile ? json(fs::absolute(found.profile->location.file).lexically_normal().string()) : json();
    info["executor"] = found.profile ? describe_executor(*found.profile) : json();
    info["notes"] = found.profile ? engine::check_properties(*found.profile, {}, options.plugin_dirs)
                                  : std::vector<std::string>();
    if (!found.unreadable.empty()) info["notes"].push_back("the profile may be " + found.unreadable);
    for (const json& absent : info["absent_properties"]) info["notes"].push_back(absent["line"]);
    info.erase("absent_properties");
    return info;
}

// The text is made from the JSON, so that both say the same.
std::string format_component(const json& info, const InspectedComponent& found,
                             const InspectOptions& options) {
    std::string text =
        fmt::format("component  {}\nlibrary    {}, {}\n", info["name"].get<std::string>(),
                    info["library"].get<std::string>(),
                    info.contains("version") ? info["version"].get<std::string>() : "no version");
    text += "profile    " +
            (found.profile              ? info["profile"].get<std::string>()
             : found.unreadable.empty() ? "none beside the library"
                                        : "none readable beside the library") +
            "\n";
    if (found.profile) text += "executor   " + format_executor(*found.profile) + "\n";
    text += "\n" + format_ports(info["ports"]);
    // A component without ports is rare: it more probably creates them in onInitialize.
    if (info["ports"].empty() && !options.initialize)
        text +=
            "to see ports created by onInitialize(), use --initialize, which runs it in a child process\n";
    if (!info["properties"].empty()) {
        Table table({"property", "value"});
        for (const auto& [name, value] : info["properties"].items())
            table.add_row({replace_control_characters(name), replace_control_characters(value)});
        text += "\n" + table.text();
    }
    if (!info["notes"].empty()) text += "\n";
    for (const json& line : info["notes"]) text += replace_control_characters(line.get<std::string>()) + "\n";
    return text;
}

} // namespace

// The kind of profile decides: only a component has a library to load.
int opros_info(const InspectOptions& options) {
    if (options.file.extension() == ".xml")
        if (const auto kind = engine::read_profile_kind(options.file);
            kind != engine::ProfileKind::component) {
            const json info = describe_profile(kind, options);
            options.json ? print_json(info) : print_text(format_profile(info));
            return 0;
        }
    const InspectedComponent found = find_component(options);
    const json info = inspect(found, options);
    if (options.json)
        print_json(info);
    else
        print_text(format_component(info, found, options));
    return 0;
}

} // namespace tandem::command
