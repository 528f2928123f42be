// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/link/component_pair.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include "apps/tandem/opros/component_profiles.hpp"
#include "apps/tandem/shared_ports/rtc_conf_ports.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/load/plugin_dirs.hpp"
#include "host/plugin/error.hpp"
#include "host/plugin/library_contents.hpp"
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

fs::path select_module(const std::vector<fs::path>& modules, const fs::path& place) {
    if (modules.size() == 1) return fs::absolute(modules.front()).lexically_normal();
    throw std::runtime_error(place.string() + " has several RTC modules: " +
                             text::join(modules, ", ", [](const fs::path& each) { return each.string(); }) +
                             "; give one of these files instead of the folder");
}

RtcType select_type(const fs::path& module, const LinkProfileOptions& options) {
    RtcConfOptions probe;
    probe.timeout_s = options.timeout_s;
    const auto types = probe_rtc_types(module, probe);
    std::vector<std::string> names;
    for (const auto& type : types) {
        if (type.name == options.type || (types.size() == 1 && options.type.empty())) return type;
        names.push_back(type.name);
    }
    throw std::runtime_error(
        module.string() + " registers " +
        (names.empty() ? "no component type" : "the component types " + text::join(names, ", ")) +
        (options.type.empty() ? "; choose one with --type NAME" : ", but not " + options.type));
}

} // namespace

ComponentPair find_component_pair(const LinkProfileOptions& options) {
    std::optional<engine::ComponentProfile> opros;
    fs::path module;
    for (const fs::path& place : {options.first, options.second}) {
        if (!fs::exists(place))
            throw std::runtime_error(place.string() + " does not exist: expected the folder of a component");
        std::string error;
        const auto modules = module_files(place);
        auto profile = modules.empty() ? find_profile(place, options.profile, error) : std::nullopt;
        if (profile ? opros.has_value() : !module.empty() && !modules.empty())
            throw std::runtime_error(options.first.string() + " and " + options.second.string() +
                                     " are both " + (profile ? "OPRoS components" : "RTCs") +
                                     ": expected one of each model");
        if (profile)
            opros = std::move(profile);
        else if (!modules.empty())
            module = select_module(modules, place);
        else
            throw std::runtime_error(
                place.string() +
                " has no built RTC (build it with tandem rtm build) and is not an OPRoS component: " + error);
    }
    const auto library = engine::find_component_library(*opros, engine::default_plugin_dirs());
    engine::require_opros_component(library);
    const RtcType type = select_type(module, options);
    return {std::move(*opros), library, module, type.name, type.category};
}

} // namespace tandem::command
