// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/component_profiles.hpp"

#include "apps/tandem/build/folder/source_text.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"

#include <algorithm>
#include <stdexcept>

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

// Searches the component's folder and the folders of OPRoS's tools. If there is none, searches the workspace's common
// folders for profiles with the folder's name.
std::vector<engine::ComponentProfile> find_component_profiles(const fs::path& folder, std::string& error) {
    std::vector<engine::ComponentProfile> found;
    for (const char* place : {"", "profile", "profiles"})
        add_component_profiles(folder / place, found, error);
    if (!found.empty() || !error.empty()) return found;
    const fs::path whole = fs::canonical(folder);
    for (const fs::path& parent : {whole.parent_path(), whole.parent_path().parent_path()})
        for (const char* place : {"profile", "profiles"}) {
            std::string of_another_component;
            add_component_profiles(parent / place, found, of_another_component);
        }
    found.erase(std::remove_if(found.begin(), found.end(),
                               [&](const auto& profile) { return profile.name != whole.filename(); }),
                found.end());
    return found;
}

} // namespace

engine::ComponentProfile select_component_profile(const fs::path& folder, const std::string& profile) {
    if (!profile.empty())
        return engine::read_component_profile(fs::exists(profile) ? fs::absolute(profile) : folder / profile);
    std::string error;
    const auto all = find_component_profiles(folder, error);
    if (!error.empty())
        throw std::runtime_error(error + "; correct the file, or give another profile with --profile FILE");
    if (all.size() == 1) return all.front();
    if (all.empty())
        throw std::runtime_error("no component profile (XML with <component_profile>) in " + folder.string() +
                                 " or its profile/; give one with --profile FILE");
    std::string names;
    for (const auto& each : all)
        names += (names.empty() ? "" : ", ") + each.location.file.lexically_relative(folder).string();
    throw std::runtime_error(folder.string() + " has several component profiles: " + names +
                             "; choose one with --profile FILE");
}

} // namespace tandem::command
