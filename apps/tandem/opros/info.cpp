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

/// The library of a component and its profile, if any.
struct InspectedComponent {
    fs::path library;
    std::optional<engine::ComponentProfile> profile;
    std::string unreadable; ///< without a profile: error of a file beside the library that may be the profile
};

// Returns whether the profile names this library, in any spelling that the host accepts.
bool refers_to(const engine::ComponentProfile& profile, const fs::path& library) {
    const auto candidates = plugin::library_file_names(profile.library_name);
    return std::find(candidates.begin(), candidates.end(), library.filename().string()) != candidates.end();
}

// Adds the component profile in the library's folder that names the library, if any.
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

// FILE is a profile, which names its library, or a library with an optional profile beside it. In the latter case, an
// error in the profile is only a note.
InspectedComponent find_component(const InspectOptions& options) {
    if (options.file.empty())
        throw std::runtime_error("FILE is empty: expected a component library or profile");
    // Only profiles have the extension .xml.
    if (options.file.extension() != ".xml") return find_profile_beside(options.file);
    auto profile = engine::read_component_profile(options.file);
    return {engine::find_component_library(profile, options.plugin_dirs), std::move(profile), ""};
}

// Describes the execution settings of the profile. A library does not contain them.
json describe_executor(const engine::ComponentProfile& profile) {
    return {{"type", to_string(profile.execution_type)},
            {"period_ms", static_cast<double>(profile.period.count()) / 1e6},
            {"phase_ms", static_cast<double>(profile.phase.count()) / 1e6},
            {"priority", profile.priority}};
}

// Checks the library's file first, which detects wrong kinds without running code, and then loads it in a child
// process.
json inspect(const InspectedComponent& found, const InspectOptions& options) {
    engine::require_opros_component(found.library);
    json info =
        describe_in_child(found.library, found.profile ? found.profile->location.file : fs::path(), options);
    // Absolute paths, because the JSON may be read in another folder. Values from a missing profile are null.
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

// Converts the JSON, so that both formats have the same contents.
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
    // A component without ports probably creates them in onInitialize.
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

// Only profiles of components have a library to load.
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
