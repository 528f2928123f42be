// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/load/load_component.hpp"

#include "host/opros/engine/load/load_probe.hpp"
#include "host/plugin/abi.hpp"
#include "host/plugin/find_library.hpp"
#include "host/plugin/library.hpp"

#include <algorithm>
#include <cctype>

#define MAKE_STATIC_COMPONENT // the host is no component
#include <ServiceUtils.h>
#include <TandemAbi.h>
#include <spdlog/spdlog.h>

namespace tandem::engine {
namespace {

/// Throws plugin::Error unless the library is of that kind and built against our headers.
void require_ours(const std::filesystem::path& library, plugin::LibraryKind kind) {
    const auto contents = plugin::read_contents(library);
    plugin::require_kind(library, contents, kind);
    plugin::require_abi(library, contents, plugin::ComponentModel::opros, TANDEM_OPROS_ABI);
}

// The last field of a version is of no consequence.
std::string significant(const std::string& version) { return version.substr(0, version.rfind('-')); }

void check_version(plugin::Library& library) {
    if (!library.has("getVersion")) return; // components of OPRoS v1 have none
    const std::string version = library.symbol<const char*()>("getVersion")();
    if (significant(version) != significant(get_opros_version()))
        spdlog::warn("library {} was made for OPRoS {}, this host is {}", library.path().string(), version,
                     get_opros_version());
}

Component* make(plugin::Library& library) {
    const auto factory = library.symbol<Component*()>("getComponent");
    std::string why = "returned NULL";
    try {
        if (Component* made = factory()) return made;
    } catch (const std::exception& error) {
        why = std::string("threw an exception: ") + error.what();
    } catch (...) {
        why = "threw an exception of unknown type";
    }
    throw SetupError("getComponent() of " + library.path().string() + " " + why);
}

bool names_device_library(std::string property) {
    std::transform(property.begin(), property.end(), property.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    const auto ends_with = [&](const std::string& end) {
        return property.size() >= end.size() &&
               property.compare(property.size() - end.size(), end.size(), end) == 0;
    };
    return ends_with("apiname") || ends_with("dllname");
}

std::vector<std::filesystem::path> search_dirs(const ComponentProfile& profile,
                                               const std::vector<std::filesystem::path>& dirs) {
    std::vector<std::filesystem::path> search{profile.location.file.parent_path()};
    search.insert(search.end(), dirs.begin(), dirs.end());
    return search;
}

std::string find_device_library(const ComponentProfile& profile, const std::string& property,
                                const std::string& value, const std::vector<std::filesystem::path>& dirs) {
    if (value.empty() || !names_device_library(property)) return value;
    std::string found = value;
    try {
        found = std::filesystem::absolute(plugin::find_library(value, search_dirs(profile, dirs))).string();
    } catch (const plugin::Error& error) {
        spdlog::info("{} {}: left to the component to find: {}", property, value, error.what());
        return value;
    }
    try { // all that the component could say is that it has no device
        require_ours(found, plugin::LibraryKind::device_api);
    } catch (const plugin::Error& error) {
        if (error.reason() == plugin::Reason::abi_mismatch) // the component could not tell, and call it
            throw SetupError(profile.location, property + " " + value + ": " + error.what());
        spdlog::warn("{} {}: {}", property, value, error.what());
    }
    return found;
}

// Components of OPRoS v1 ask for APIName, and open DllName on Linux.
void give_device_library_all_names(std::map<std::string, std::string>& properties) {
    const char* const names[] = {"APIName", "ApiName", "DllName"};
    std::string library;
    for (const char* name : names)
        if (library.empty() && properties.count(name) != 0) library = properties[name];
    if (library.empty()) return;
    for (const char* name : names) properties.emplace(name, library);
}

} // namespace

void require_opros_component(const std::filesystem::path& library) {
    require_ours(library, plugin::LibraryKind::opros_component);
}

LoadedComponent instantiate_component(const std::filesystem::path& file) {
    const auto library = plugin::Library::load(file);
    plugin::require_abi_of_process(plugin::ComponentModel::opros, TANDEM_OPROS_ABI, library->path());
    check_version(*library);
    void (*release)(Component*) = [](Component* dying) { delete dying; };
    if (library->has("releaseComponent")) release = library->symbol<void(Component*)>("releaseComponent");
    return {library, plugin::share_instance(library, make(*library), release)};
}

std::filesystem::path find_component_library(const ComponentProfile& profile,
                                             const std::vector<std::filesystem::path>& dirs) {
    try {
        return plugin::find_library(profile.library_name, search_dirs(profile, dirs));
    } catch (const plugin::Error& error) {
        throw SetupError(profile.library_location, error.what());
    }
}

void set_component_properties(Component& component, const ComponentProfile& profile, const Properties& more,
                              const std::vector<std::filesystem::path>& dirs) {
    const auto folder = std::filesystem::absolute(profile.location.file).parent_path();
    component.setProperty(folder_property_names[0], (folder / "res" / "").string());
    component.setProperty(folder_property_names[1], (folder / "").string());
    for (const Properties* properties : {&profile.properties, &more})
        for (const auto& [key, value] : *properties)
            component.setProperty(key, find_device_library(profile, key, value, dirs));
    give_device_library_all_names(component.getPropertyMap());
}

LoadedComponent load_component(const ComponentProfile& profile,
                               const std::vector<std::filesystem::path>& dirs,
                               const std::optional<plugin::ProbeOptions>& probe) {
    const auto file = find_component_library(profile, dirs);
    try {
        require_opros_component(file);
        if (probe) plugin::run_probe(*probe, load_probe_task, file);
        return instantiate_component(file);
    } catch (const std::runtime_error& error) {
        throw SetupError(profile.library_location, error.what());
    }
}

} // namespace tandem::engine
