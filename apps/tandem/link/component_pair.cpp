// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/link/component_pair.hpp"
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/build/plain_path.hpp"

#include "apps/tandem/opros/component_profiles.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/plugin/error.hpp"
#include "host/plugin/library_contents.hpp"
#include "host/plugin/plugin_dirs.hpp"
#include "host/text/join.hpp"

#include <optional>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

bool is_module(const fs::path& file) {
    if (file.extension() != ".so") return false;
    try {
        return plugin::read_contents(file).kind == plugin::LibraryKind::rtc_module;
    } catch (const plugin::Error&) {
        return false; // an unreadable library cannot be joined
    }
}

// Returns the modules in the folder, or in the output folders of RTC projects with CMake.
std::vector<fs::path> module_files(const fs::path& place) {
    if (fs::is_regular_file(place)) return is_module(place) ? std::vector{place} : std::vector<fs::path>();
    for (const char* below : {"", "lib", "build/src", "build/lib", "build"}) {
        std::vector<fs::path> found;
        std::error_code ignored; // a missing folder has no modules
        for (const auto& entry : fs::directory_iterator(place / below, ignored))
            if (is_module(entry.path())) found.push_back(entry.path());
        if (!found.empty()) return found;
    }
    return {};
}

// Returns the profile of an OPRoS component; nullopt with the reason in `error` if there is none.
std::optional<engine::ComponentProfile> find_profile(const fs::path& place, const std::string& profile,
                                                     std::string& error) {
    try {
        if (is_xml(place)) return engine::read_component_profile(fs::absolute(place));
        return select_component_profile(fs::absolute(place), profile);
    } catch (const std::runtime_error& cause) {
        error = cause.what();
        return std::nullopt;
    }
}

} // namespace

ComponentFiles find_component_files(const fs::path& place, const std::string& profile) {
    ComponentFiles files{module_files(place), std::nullopt, ""};
    if (files.modules.empty()) files.opros = find_profile(place, profile, files.error);
    return files;
}

fs::path select_module(const ComponentFiles& files, const fs::path& place) {
    const auto& modules = files.modules;
    if (modules.size() == 1) return fs::absolute(modules.front()).lexically_normal();
    throw std::runtime_error(place.string() + " has several RTC modules: " +
                             text::join(modules, ", ", [](const fs::path& each) { return each.string(); }) +
                             "; give one of these files instead of the folder");
}

RtcType select_type(const fs::path& module, const std::string& name, double timeout_s) {
    RtcConfOptions probe;
    probe.timeout_s = timeout_s;
    const auto types = probe_rtc_types(module, probe);
    std::vector<std::string> names;
    for (const auto& type : types) {
        if (type.name == name || (types.size() == 1 && name.empty())) {
            require_conf_type(type.name, type.category, module);
            return type;
        }
        names.push_back(type.name);
    }
    throw std::runtime_error(
        module.string() + " registers " +
        (names.empty() ? "no component type" : "the component types " + text::join(names, ", ")) +
        (name.empty() ? "; choose one with --type NAME" : ", but not " + name));
}

ComponentPair find_component_pair(const LinkProfileOptions& options) {
    std::optional<engine::ComponentProfile> opros;
    fs::path module;
    for (const fs::path& place : {options.first, options.second}) {
        if (!fs::exists(place))
            throw std::runtime_error(place.string() + " does not exist: expected the folder of a component");
        auto files = find_component_files(place, options.profile);
        if (files.opros ? opros.has_value() : !module.empty() && !files.modules.empty())
            throw std::runtime_error(options.first.string() + " and " + options.second.string() +
                                     " are both " + (files.opros ? "OPRoS components" : "RTCs") +
                                     ": expected one of each model");
        if (files.opros)
            opros = std::move(files.opros);
        else if (!files.modules.empty())
            module = select_module(files, place);
        else
            throw std::runtime_error(
                place.string() +
                " has no built RTC (build it with tandem rtm build) and is not an OPRoS component: " +
                files.error);
    }
    const auto library = engine::find_component_library(*opros, plugin::default_plugin_dirs("opros"));
    engine::require_opros_component(library);
    const RtcType type = select_type(module, options.type, options.timeout_s);
    return {std::move(*opros), library, module, type.name, type.category};
}

} // namespace tandem::command
