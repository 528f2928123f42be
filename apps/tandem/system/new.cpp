// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/plain_path.hpp"
#include "apps/tandem/link/component_pair.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/system/commands.hpp"
#include "apps/tandem/system/staged_folder.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/plugin/plugin_dirs.hpp"
#include "shm/segment/segment_file.hpp"

#include <fmt/ranges.h>
#include <pugixml.hpp>

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

/// A kind of component, and how many of it the system has.
struct Part {
    engine::ComponentProfile opros{}; ///< without a name: it is an RTC
    fs::path module{};
    RtcType type{};
    int count = 0;
};

Part find_part(const fs::path& place, const NewSystemOptions& options) {
    if (!fs::exists(place))
        throw std::runtime_error(place.string() + " does not exist: expected the folder of a component");
    auto files = find_component_files(place);
    Part part;
    if (files.opros) {
        part.opros = std::move(*files.opros);
        engine::require_opros_component(
            engine::find_component_library(part.opros, plugin::default_plugin_dirs("opros")));
    } else if (!files.modules.empty()) {
        part.module = select_module(files, place);
        require_conf_path(part.module);
        part.type = select_type(part.module, "", options.timeout_s);
    } else {
        throw std::runtime_error(place.string() + " has no built component of either model: " + files.error);
    }
    return part;
}

/// Returns the different components, in the order of their first mention.
std::vector<Part> find_parts(const NewSystemOptions& options) {
    std::vector<Part> parts;
    std::map<fs::path, std::size_t> known;
    for (const auto& place : options.components) {
        const auto [found, is_new] = known.try_emplace(fs::weakly_canonical(place), parts.size());
        if (is_new) parts.push_back(find_part(place, options));
        ++parts[found->second].count;
    }
    return parts;
}

/// Returns the names of a component's instances: `Arm`, or `Arm0` and `Arm1`.
std::vector<std::string> opros_names(const Part& part) {
    if (part.count == 1) return {part.opros.name};
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(part.count));
    for (int i = 0; i < part.count; ++i) names.push_back(part.opros.name + std::to_string(i));
    return names;
}

void add_component(pugi::xml_node list, const std::string& name, const std::string& reference,
                   const std::vector<std::pair<const char*, std::string>>& properties = {}) {
    auto entry = list.append_child("subcomponent");
    entry.append_child("name").text().set(name.c_str());
    entry.append_child("reference").text().set(reference.c_str());
    if (properties.empty()) return;
    auto values = entry.append_child("properties");
    for (const auto& [key, value] : properties) {
        auto property = values.append_child("property");
        property.append_attribute("name") = key;
        property.text().set(value.c_str());
    }
}

constexpr char adaptor_name[] = "Adaptor";

/// Throws std::runtime_error if two components of the application would have the same name.
void require_different_names(const std::vector<Part>& parts) {
    std::map<std::string, fs::path> known{{adaptor_name, "AdaptorComp.xml"}};
    for (const Part& part : parts) {
        if (part.opros.name.empty()) continue;
        for (const auto& name : opros_names(part))
            if (const auto [other, is_new] = known.try_emplace(name, part.opros.location.file); !is_new)
                throw std::runtime_error(
                    fmt::format("{} and {} would both be components with the name {}; rename one of them",
                                other->second.string(), part.opros.location.file.string(), name));
    }
}

std::string application_text(const std::vector<Part>& parts, const std::string& link) {
    pugi::xml_document document;
    auto declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "UTF-8";
    auto package = document.append_child("package_profile");
    package.append_child("name").text().set(link.c_str());
    auto list = package.append_child("subcomponents");
    std::vector<std::string> shared;
    for (const Part& part : parts) {
        if (part.opros.name.empty()) continue;
        for (const auto& name : opros_names(part)) {
            add_component(list, name, part.opros.location.file.string());
            shared.push_back(name);
        }
    }
    if (shared.empty()) return "";
    add_component(list, adaptor_name, "AdaptorComp.xml",
                  {{"link", link}, {"share", fmt::format("{}", fmt::join(shared, ", "))}});
    package.append_child("port_connections");
    std::ostringstream text;
    document.save(text, "  ");
    return text.str();
}

std::string rtc_conf_text(const std::vector<Part>& parts, const std::string& link, bool has_link) {
    std::vector<std::string> folders, modules, created;
    std::string settings;
    for (const Part& part : parts) {
        if (part.module.empty()) continue;
        const fs::path folder = part.module.parent_path(), conf = folder / (part.type.name + ".conf");
        folders.push_back(folder.string());
        modules.push_back(part.module.filename().string());
        created.insert(created.end(), static_cast<std::size_t>(part.count), part.type.name);
        if (fs::exists(conf))
            settings +=
                fmt::format("{}.{}.config_file: {}\n", part.type.category, part.type.name, conf.string());
    }
    if (has_link) {
        modules.emplace_back("InterceptorComp.so");
        created.push_back("InterceptorComp?link=" + link);
    }
    return fmt::format("# Written by tandem system new. Start rtm_host in this folder, as tandem run does.\n"
                       "naming.enable: NO\nlogger.log_level: WARN\nmanager.shutdown_auto: NO\n"
                       "manager.modules.load_path: {}\nmanager.modules.preload: {}\n"
                       "manager.components.precreate: {}\n{}",
                       folders.empty() ? "." : fmt::format("{}", fmt::join(folders, ", ")),
                       fmt::join(modules, ", "), fmt::join(created, ", "), settings);
}

} // namespace

int system_new(const NewSystemOptions& options) {
    const fs::path whole = fs::absolute(options.folder).lexically_normal();
    const std::string link = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
    shm::check_link_name(link);
    const auto parts = find_parts(options);
    require_different_names(parts);
    const std::string application = application_text(parts, link);
    StagedFolder staged(options.folder);
    write_file(staged.add_side("rtm") / "rtc.conf", rtc_conf_text(parts, link, !application.empty()));
    if (!application.empty()) write_file(staged.add_side("opros") / (link + ".xml"), application);
    staged.publish();
    print_text("written " + options.folder.string() + "\nnext: tandem run " + options.folder.string() + "\n");
    return 0;
}

} // namespace tandem::command
