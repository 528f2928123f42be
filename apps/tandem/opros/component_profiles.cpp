// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/component_profiles.hpp"

#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"
#include "host/text/join.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Adds the component profiles in a folder and skips other XML files. `error`: of the first unreadable file, which may
// be the intended one.
void add_component_profiles(const fs::path& folder, std::vector<engine::ComponentProfile>& found,
                            std::string& error) {
    for (const auto& file : list_entries(folder, ".xml")) {
        try {
            if (engine::find_profile_kind(file) == engine::ProfileKind::component)
                found.push_back(engine::read_component_profile(file));
        } catch (const engine::SetupError& cause) {
            if (error.empty()) error = cause.what();
        }
    }
}

using Profiles = std::vector<engine::ComponentProfile>;

// A part of a profile and its value as text.
struct Aspect {
    const char* name;
    std::string value;
    bool is_short = false; // for messages
};

std::vector<Aspect> aspects_of(const engine::ComponentProfile& profile) {
    std::string properties, ports, execution;
    for (const auto& [name, value] : profile.properties) properties += name + '=' + value + '\n';
    for (const auto& port : profile.data_ports)
        ports += fmt::format("{} {} {}\n", port.name, port.data_type, port.is_input);
    for (const auto& port : profile.event_ports)
        ports += fmt::format("{} {} {}\n", port.name, port.data_type, port.is_input);
    for (const auto& port : profile.service_ports)
        ports += fmt::format("{} {} {}\n", port.name, port.type, port.is_provided);
    execution = fmt::format("{} {} {} {}", static_cast<int>(profile.execution_type), profile.period.count(),
                            profile.phase.count(), profile.priority);
    return {{"<name>", profile.name, true},
            {"<library_name>", profile.library_name, true},
            {"execution", execution},
            {"properties", properties},
            {"ports", ports}};
}

bool is_source_folder(const fs::path& folder) {
    const auto name = to_lower(folder.filename().string());
    return name == "src" || name == "source" || name == "sources";
}

// Searches the component's folder and the folders of OPRoS's tools. If there is none, searches the folder above and the
// workspace's common folders for profiles with the folder's name.
Profiles find_component_profiles(const fs::path& folder, std::string& error) {
    Profiles found;
    for (const char* place : {"", "profile", "profiles"})
        add_component_profiles(folder / place, found, error);
    if (!found.empty() || !error.empty()) return found;
    const fs::path whole = fs::canonical(folder);
    if (is_source_folder(whole)) return find_component_profiles(whole.parent_path(), error);
    for (const fs::path& parent : {whole.parent_path(), whole.parent_path().parent_path()})
        for (const char* place : {"", "profile", "profiles"}) {
            std::string of_another_component;
            add_component_profiles(parent / place, found, of_another_component);
        }
    std::erase_if(found, [&](const auto& profile) { return profile.name != whole.filename(); });
    return found;
}

// Removes the profiles that equal an earlier one.
void remove_copies(Profiles& profiles) {
    Profiles distinct;
    for (auto& profile : profiles)
        if (std::none_of(distinct.begin(), distinct.end(),
                         [&](const auto& other) { return find_difference(other, profile).empty(); }))
            distinct.push_back(std::move(profile));
    profiles = std::move(distinct);
}

} // namespace

std::string find_difference(const engine::ComponentProfile& one, const engine::ComponentProfile& other) {
    const auto ones = aspects_of(one), others = aspects_of(other);
    for (std::size_t i = 0; i < ones.size(); ++i)
        if (ones[i].value != others[i].value)
            return ones[i].is_short
                       ? fmt::format("{}: {} and {}", ones[i].name, ones[i].value, others[i].value)
                       : ones[i].name;
    return "";
}

engine::ComponentProfile select_component_profile(const fs::path& folder, const std::string& profile) {
    if (!profile.empty())
        return engine::read_component_profile(fs::exists(profile) ? fs::absolute(profile) : folder / profile);
    std::string error;
    auto all = find_component_profiles(folder, error);
    if (!error.empty())
        throw std::runtime_error(error + "; correct the file, or give another profile with --profile FILE");
    remove_copies(all);
    if (all.size() == 1) return all.front();
    if (all.empty())
        throw std::runtime_error("no component profile (XML with <component_profile>) in " + folder.string() +
                                 ", its profile/ or the folder above; give one with --profile FILE");
    const std::string names = text::join(
        all, ", ", [&](const auto& each) { return each.location.file.lexically_proximate(folder).string(); });
    const auto& first = all.front();
    if (std::all_of(all.begin(), all.end(),
                    [&](const auto& each) { return each.library_name == first.library_name; })) {
        print_note("tandem: {}, of one library, differ in {}; using the first\n", names,
                   find_difference(first, all[1]));
        return first;
    }
    throw std::runtime_error(folder.string() + " has several component profiles: " + names +
                             "; the first two differ in " + find_difference(first, all[1]) +
                             "; choose one with --profile FILE");
}

} // namespace tandem::command
