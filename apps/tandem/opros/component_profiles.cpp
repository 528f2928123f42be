// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/component_profiles.hpp"

#include "apps/tandem/build/folder/source_text.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// What is wrong with a file that is not a readable component profile; "" if it is one of another kind.
std::string profile_error(const fs::path& file, const engine::SetupError& error) {
    try {
        return engine::read_profile_kind(file) == engine::ProfileKind::component ? error.what() : "";
    } catch (const engine::SetupError& cause) {
        // Other XML files, such as data of OpenCV, have a root element that no profile has.
        return std::strstr(cause.what(), "not well-formed XML") ? cause.what() : "";
    }
}

// The component profiles in a folder; others are passed over. `error`: of the first file that would be one, were it not
// for the error.
void add_component_profiles(const fs::path& folder, std::vector<engine::ComponentProfile>& found,
                            std::string& error) {
    for (const auto& file : list_files(folder)) {
        if (file.extension() != ".xml") continue;
        try {
            found.push_back(engine::read_component_profile(file));
        } catch (const engine::SetupError& cause) {
            if (error.empty()) error = profile_error(file, cause);
        }
    }
}

// Those in the component's folder and where OPRoS's own tools put them; without one, those of the folder's name that a
// workspace has for all of its components.
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
    if (all.size() == 1) return all.front();
    if (all.empty() && !error.empty()) throw std::runtime_error(error);
    if (all.empty())
        throw std::runtime_error("no component profile (XML with <component_profile>) in " + folder.string() +
                                 " nor in its profile/; name one with --profile FILE");
    std::string names;
    for (const auto& each : all)
        names += (names.empty() ? "" : ", ") + each.location.file.lexically_relative(folder).string();
    throw std::runtime_error(folder.string() + " has several component profiles: " + names +
                             "; name one with --profile FILE");
}

} // namespace tandem::command
