// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/load/load_component.hpp"

#include "host/log/log.hpp"
#include "host/opros/engine/load/device_library.hpp"
#include "host/opros/engine/profile/component_profile.hpp"
#include "host/opros/engine/profile/xml_file.hpp"
#include "host/plugin/abi.hpp"
#include "host/plugin/find_library.hpp"
#include "host/plugin/library.hpp"
#include "host/text/nearest_name.hpp"
#include "host/text/parse_number.hpp"

#include <algorithm>
#include <cctype>

#define MAKE_STATIC_COMPONENT // the host is not a component
#include <ServiceUtils.h>
#include <TandemAbi.h>

namespace tandem::engine {
namespace {

enum class Kind { whole_number, number, truth, text };

/// The types that profiles use, spelled as in C++.
struct PropertyType {
    const char* name;
    Kind kind;
};
constexpr PropertyType property_types[] = {
    {"int", Kind::whole_number},
    {"unsigned int", Kind::whole_number},
    {"short", Kind::whole_number},
    {"unsigned short", Kind::whole_number},
    {"long", Kind::whole_number},
    {"unsigned long", Kind::whole_number},
    {"long long", Kind::whole_number},
    {"unsigned long long", Kind::whole_number},
    {"double", Kind::number},
    {"float", Kind::number},
    {"bool", Kind::truth},
    {"string", Kind::text},
    {"std::string", Kind::text},
    {"char", Kind::text},
    {"unsigned char", Kind::whole_number},
};

/// Returns what a value of this kind must be, or an empty string if the text is such a value.
std::string expected_instead(Kind kind, const std::string& value) {
    switch (kind) {
    case Kind::whole_number: // accepts 50.0: components use atoi(), which reads it as 50
        return text::parse_number(value) ? "" : "a whole number";
    case Kind::number:
        return text::parse_number(value) ? "" : "a number";
    case Kind::truth: {
        const std::string word = XmlFile::keyword(value);
        return word == "true" || word == "false" || word == "1" || word == "0" ? "" : "true or false";
    }
    case Kind::text:
        break;
    }
    return "";
}

/// Returns the error in the type or the value of a property, or an empty string. Does not check an unknown type with
/// characters other than letters and blanks, such as vector<int>.
std::string type_error(const std::string& name, const std::string& type, const std::string& value) {
    const auto is_plain = [](unsigned char c) { return std::isalpha(c) || c == ' '; };
    const auto* const end = std::end(property_types);
    const auto* const known = std::find_if(std::begin(property_types), end,
                                           [&](const PropertyType& each) { return type == each.name; });
    if (known == end)
        return type.empty() || !std::all_of(type.begin(), type.end(), is_plain)
                   ? ""
                   : "property " + name + " has the unknown type '" + type +
                         "', expected int, double, string, bool or another type of C++";
    const std::string expected = expected_instead(known->kind, value);
    return expected.empty()
               ? ""
               : "property " + name + " is '" + value + "', expected " + expected + " (type " + type + ")";
}

/// Returns the device library property that `name` probably means: one that starts with `name` or differs by one
/// letter. Returns an empty string if there is none.
std::string device_library_name_meant(const std::string& name) {
    if (name.size() >= 3)
        for (std::string known : device_library_names)
            if (known.compare(0, name.size(), name) == 0) return known;
    const std::string word = XmlFile::keyword(name);
    for (const char* known : device_library_names) {
        const std::string lower = XmlFile::keyword(known);
        if (word.size() >= 3 &&
            (lower.compare(0, word.size(), word) == 0 || text::edit_distance(word, lower) == 1))
            return known;
    }
    return "";
}

/// Without any of these names, a component does not start and reports only an error number.
void add_misspelt_device_library(const ComponentProfile& profile, std::vector<std::string>& errors) {
    const auto has = [&](const char* name) {
        return std::any_of(profile.properties.begin(), profile.properties.end(),
                           [&](const auto& property) { return property.first == name; });
    };
    if (std::any_of(std::begin(device_library_names), std::end(device_library_names), has)) return;
    for (const PropertyProfile& property : profile.property_profiles)
        if (const std::string meant = device_library_name_meant(property.name); !meant.empty())
            errors.push_back(
                property.location.text() + ": property " + property.name +
                ": components ask for their device library as APIName, ApiName or DllName; did you mean " +
                meant + "?");
}

/// Returns one line for each property error that the profile alone shows: a missing name, a value that does not fit
/// its type, or a name that resembles a device library property. A value that is overridden does not count. Does not
/// throw for them: upstream's engine does not read the types, and the component may not need the property.
std::vector<std::string> find_property_type_errors(const ComponentProfile& profile,
                                                   const Properties& overrides) {
    std::vector<std::string> errors;
    for (const PropertyProfile& property : profile.property_profiles) {
        const auto is_it = [&](const auto& each) { return each.first == property.name; };
        if (std::any_of(overrides.begin(), overrides.end(), is_it)) continue;
        const std::string error = property.name.empty()
                                      ? "<property> lacks its attribute name"
                                      : type_error(property.name, property.type, property.value);
        if (!error.empty()) errors.push_back(property.location.text() + ": " + error);
    }
    add_misspelt_device_library(profile, errors);
    return errors;
}

/// Returns one line for each value of the application that does not fit the type in the component's profile.
std::vector<std::string> find_override_errors(const ComponentProfile& profile, const Subcomponent& entry) {
    std::vector<std::string> errors;
    for (const auto& [name, value] : entry.properties)
        for (const PropertyProfile& property : profile.property_profiles)
            if (property.name == name)
                if (const auto error = type_error(name, property.type, XmlFile::trim(value)); !error.empty())
                    errors.push_back(entry.location.text() + ": component '" + entry.name + "': " + error);
    return errors;
}

std::string without_digits(std::string name) {
    std::erase_if(name, [](char c) { return c >= '0' && c <= '9'; });
    return name;
}

/// Returns one line for each property that only the application has and whose name resembles a property that only the
/// profile has. Other names may be right, for example `joint2` beside `joint1`: the profile need not list all properties
/// that a component reads.
std::vector<std::string> find_misspelt_overrides(const ComponentProfile& profile, const Subcomponent& entry) {
    const auto has = [](const Properties& properties, const std::string& name) {
        return std::any_of(properties.begin(), properties.end(),
                           [&](const auto& property) { return property.first == name; });
    };
    std::vector<std::string> errors;
    for (const auto& [name, value] : entry.properties) {
        if (has(profile.properties, name)) continue;
        std::vector<std::string> known;
        for (const auto& [other, other_value] : profile.properties)
            if (!has(entry.properties, other) && without_digits(other) != without_digits(name))
                known.push_back(other);
        if (const std::string meant = text::did_you_mean(name, known); !meant.empty())
            errors.push_back(entry.location.text() + ": component '" + entry.name + "': " +
                             profile.location.file.filename().string() + " has no property " + name + meant);
    }
    return errors;
}

/// Throws plugin::Error unless the library is of this kind and built against headers with this process's ABI number.
plugin::LibraryContents require_library(const std::filesystem::path& library, plugin::LibraryKind kind) {
    auto contents = plugin::read_contents(library);
    plugin::require_kind(library, contents, kind);
    plugin::require_abi(library, contents, plugin::ComponentModel::opros, TANDEM_OPROS_ABI);
    return contents;
}

/// "BRILL-1-0-0-0" -> "BRILL-1-0-0": the last field of an OPRoS version does not count.
std::string without_last_field(const std::string& version) { return version.substr(0, version.rfind('-')); }

/// Another version only causes a warning: the ABI number, not the version, shows whether the library fits.
void check_version(plugin::Library& library) {
    if (!library.has("getVersion")) return; // components of OPRoS v1 have none
    const std::string version = library.symbol<const char*()>("getVersion")();
    if (without_last_field(version) != without_last_field(get_opros_version()))
        log::warn("library {} was made for OPRoS {}, but this host is {}", library.path().string(), version,
                  get_opros_version());
}

/// Returns how to build the library that a profile names; empty if there are no component sources near the profile.
std::string build_hint(const ComponentProfile& profile) {
    namespace fs = std::filesystem;
    fs::path folder = profile.location.file.parent_path();
    // The OPRoS tools put the profile of a source file there.
    if (folder.filename() == "profile" || folder.filename() == "profiles") folder = folder.parent_path();
    for (const fs::path& sources : {folder, folder / "src"}) {
        std::error_code ignored; // a missing folder has no sources
        for (const auto& entry : fs::directory_iterator(sources.empty() ? "." : sources, ignored))
            if (entry.path().extension() == ".cpp")
                return "; tandem opros build " + (folder.empty() ? "." : folder.string()) + " builds it";
    }
    return "";
}

Component* call_factory(plugin::Library& library) {
    const auto factory = library.symbol<Component*()>("getComponent");
    std::string why = "returned NULL";
    try {
        if (Component* made = factory()) return made;
    } catch (const std::exception& error) {
        why = std::string("threw an exception: ") + error.what();
    } catch (...) { // the factory is the user's code and may throw any type
        why = "threw an exception of unknown type";
    }
    throw SetupError("getComponent() of " + library.path().string() + " " + why);
}

/// Returns the line of a property in the profile, or of the profile itself if only the application has the property.
const SourceLocation& property_location(const ComponentProfile& profile, const std::string& name) {
    for (const PropertyProfile& property : profile.property_profiles)
        if (property.name == name) return property.location;
    return profile.location;
}

/// Returns the value to set for a property: the path of the device library, if the property names an existing one.
/// Components open the library themselves with dlopen(), which does not know the plugin folders.
std::string resolve_device_library(const ComponentProfile& profile, const std::string& property,
                                   const std::string& value,
                                   const std::vector<std::filesystem::path>& plugin_dirs) {
    if (value.empty() || !is_device_library_property(property)) return value;
    std::string path;
    try {
        path = std::filesystem::absolute(plugin::find_library(value, search_dirs(profile, plugin_dirs)))
                   .string();
    } catch (const plugin::Error&) {
        return value; // check_properties() reports it
    }
    try {
        require_library(path, plugin::LibraryKind::device_api);
    } catch (const plugin::Error& error) {
        // A component detects a library without GetAPI. It calls a library with different virtual tables, and crashes.
        if (error.reason() == plugin::Reason::abi_mismatch)
            throw SetupError(profile.location, property + " " + value + ": " + error.what());
        log::warn("{} {}: {}", property, value, error.what());
    }
    return path;
}

bool is_device_library_name(const std::string& property) {
    return std::find(std::begin(device_library_names), std::end(device_library_names), property) !=
           std::end(device_library_names);
}

/// Returns the profile's properties without those that the application overrides, because the files that the latter
/// name must not be searched for. A device library that the application names overrides all three names.
Properties merged_properties(const ComponentProfile& profile, const Properties& overrides) {
    const auto names_library = [](const auto& property) { return is_device_library_name(property.first); };
    const bool other_library = std::any_of(overrides.begin(), overrides.end(), names_library);
    Properties merged;
    for (const auto& property : profile.properties) {
        const auto same_name = [&](const auto& each) { return each.first == property.first; };
        if (std::any_of(overrides.begin(), overrides.end(), same_name)) continue;
        if (!(other_library && names_library(property))) merged.push_back(property);
    }
    merged.insert(merged.end(), overrides.begin(), overrides.end());
    return merged;
}

/// Sets each of the three names to the value that one of them has.
void copy_device_library_to_aliases(std::map<std::string, std::string>& properties) {
    std::string library;
    for (const char* name : device_library_names)
        if (library.empty() && properties.count(name) != 0) library = properties[name];
    if (library.empty()) return;
    for (const char* name : device_library_names) properties.emplace(name, library);
}

} // namespace

plugin::LibraryContents require_opros_component(const std::filesystem::path& library) {
    return require_library(library, plugin::LibraryKind::opros_component);
}

LoadedComponent instantiate_component(const std::filesystem::path& file) {
    const auto library = plugin::Library::load(file);
    plugin::require_abi_of_process(plugin::ComponentModel::opros, TANDEM_OPROS_ABI, library->path());
    check_version(*library);
    void (*release)(Component*) = [](Component* component) { delete component; };
    if (library->has("releaseComponent")) release = library->symbol<void(Component*)>("releaseComponent");
    return {library, plugin::share_instance(library, call_factory(*library), release)};
}

std::filesystem::path find_component_library(const ComponentProfile& profile,
                                             const std::vector<std::filesystem::path>& plugin_dirs) {
    try {
        return plugin::find_library(profile.library_name, search_dirs(profile, plugin_dirs));
    } catch (const plugin::Error& error) {
        throw SetupError(profile.library_location, error.what() + build_hint(profile));
    }
}

std::vector<std::string> check_properties(const ComponentProfile& profile, const Subcomponent& entry,
                                          const std::vector<std::filesystem::path>& plugin_dirs) {
    std::vector<std::string> errors = profile.structure_errors;
    for (auto& error : find_property_type_errors(profile, entry.properties))
        errors.push_back(std::move(error));
    for (auto& error : find_override_errors(profile, entry)) errors.push_back(std::move(error));
    for (auto& error : find_misspelt_overrides(profile, entry)) errors.push_back(std::move(error));
    const auto dirs = search_dirs(profile, plugin_dirs);
    for (const auto& [name, value] : merged_properties(profile, entry.properties)) {
        if (value.empty() || !is_device_library_property(name)) continue;
        try {
            plugin::find_library(value, dirs);
        } catch (const plugin::Error& error) {
            errors.push_back(property_location(profile, name).text() + ": property " + name + ": device " +
                             error.what() + nearest_library(value, dirs));
        }
    }
    return errors;
}

void set_component_properties(Component& component, const ComponentProfile& profile,
                              const Properties& overrides,
                              const std::vector<std::filesystem::path>& plugin_dirs) {
    // The empty last element adds the final '/', which components need when they append a file name.
    const auto folder = std::filesystem::absolute(profile.location.file).parent_path();
    component.setProperty(folder_property_names[0], (folder / "res" / "").string());
    component.setProperty(folder_property_names[1], (folder / "").string());
    for (const auto& [key, value] : merged_properties(profile, overrides))
        component.setProperty(key, resolve_device_library(profile, key, value, plugin_dirs));
    copy_device_library_to_aliases(component.getPropertyMap());
}

void begin_probes(plugin::ParallelProbes& probes, const std::vector<ComponentProfile>& profiles,
                  const std::vector<std::filesystem::path>& plugin_dirs) {
    for (const ComponentProfile& profile : profiles) {
        try {
            const auto file = find_component_library(profile, plugin_dirs);
            if (!require_opros_component(file).trusted) probes.begin(file);
        } catch (const std::runtime_error&) { // load_component() reports the same error
        }
    }
}

LoadedComponent load_component(const ComponentProfile& profile,
                               const std::vector<std::filesystem::path>& plugin_dirs,
                               plugin::ParallelProbes* probes) {
    const auto file = find_component_library(profile, plugin_dirs);
    try {
        const bool trusted = require_opros_component(file).trusted;
        // Once for all components of a library: a library that has been loaded has passed the trial, which takes
        // milliseconds.
        if (probes != nullptr && !trusted && !plugin::Library::is_loaded(file)) probes->finish(file);
        return instantiate_component(file);
    } catch (const std::runtime_error& error) {
        throw SetupError(profile.library_location, error.what());
    }
}

} // namespace tandem::engine
