// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/load/device_library.hpp"

#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/runtime/component/absent_property.hpp"
#include "host/plugin/error.hpp"
#include "host/plugin/find_library.hpp"
#include "host/text/nearest_name.hpp"

#include <algorithm>
#include <cctype>

namespace tandem::engine {
namespace {

namespace fs = std::filesystem;

/// Returns `GripperAPI` for GripperAPI.dll, libGripperAPI.so and similar names.
std::string library_stem(const std::string& name) {
    return fs::path(plugin::library_file_names(name).back()).filename().stem().stem().string();
}

/// Returns how to use the device library of the component's class (Gripper for GripperComp) if the plugin folders have
/// one: they contain the simulated devices.
std::string simulated_device(std::string component, const std::vector<fs::path>& plugin_dirs) {
    for (const std::string end : {"Component", "Comp"})
        if (component.ends_with(end)) component.erase(component.size() - end.size());
    for (const char* end : {"Api", "API"}) {
        try {
            plugin::find_library(component + end, plugin_dirs);
            return "; for a simulated device, set it to " + component + end;
        } catch (const plugin::Error&) { // the other spelling, or none
        }
    }
    return "";
}

/// Returns the property that names a device library which does not exist, or an empty string. Prefers a name of the
/// profile to its aliases.
std::string missing_library(PropertyInterface& component, const ComponentProfile& profile) {
    std::string missing;
    std::error_code ignored; // a path that cannot be examined is missing
    for (const auto& [name, value] : component.getPropertyMap()) {
        if (value.empty() || !is_device_library_property(name) || fs::exists(value, ignored)) continue;
        const auto is_it = [&known = name](const auto& property) { return property.first == known; };
        if (std::any_of(profile.properties.begin(), profile.properties.end(), is_it)) return name;
        missing = name;
    }
    return missing;
}

std::vector<std::string> property_names(PropertyInterface& component) {
    std::vector<std::string> names;
    for (const auto& [name, value] : component.getPropertyMap())
        if (std::find(std::begin(folder_property_names), std::end(folder_property_names), name) ==
            std::end(folder_property_names))
            names.push_back(name);
    return names;
}

} // namespace

bool is_device_library_property(std::string property) {
    std::transform(property.begin(), property.end(), property.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return property.ends_with("apiname") || property.ends_with("dllname");
}

std::vector<fs::path> search_dirs(const ComponentProfile& profile, const std::vector<fs::path>& plugin_dirs) {
    std::vector<fs::path> dirs{profile.location.file.parent_path()};
    dirs.insert(dirs.end(), plugin_dirs.begin(), plugin_dirs.end());
    return dirs;
}

std::string nearest_library(const std::string& name, const std::vector<fs::path>& dirs) {
    std::vector<std::string> stems;
    for (const auto& dir : dirs) {
        std::error_code ignored; // a missing folder has no libraries
        for (const auto& entry : fs::directory_iterator(dir.empty() ? "." : dir, ignored))
            if (entry.path().extension() == ".so")
                stems.push_back(library_stem(entry.path().filename().string()));
    }
    return text::did_you_mean(library_stem(name), stems);
}

void forget_absent_property() { take_absent_property(); }

std::string describe_missing_setting(ReturnType code, PropertyInterface& component,
                                     const ComponentProfile& profile,
                                     const std::vector<fs::path>& plugin_dirs) {
    const std::string library = code == OPROS_FIND_DLL_ERROR ? missing_library(component, profile) : "";
    if (!library.empty())
        return "; device library '" + component.getPropertyMap()[library] + "' of property " + library +
               " does not exist" + simulated_device(profile.name, plugin_dirs);
    const std::string absent = take_absent_property();
    if (absent.empty()) return "";
    const std::string text = "; it asks for property " + absent + ", which " +
                             profile.location.file.filename().string() + " lacks";
    return text + (is_device_library_property(absent)
                       ? simulated_device(profile.name, plugin_dirs)
                       : text::did_you_mean(absent, property_names(component)));
}

} // namespace tandem::engine
