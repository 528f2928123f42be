// SPDX-License-Identifier: Apache-2.0
// tandem opros build: builds a component from its folder, under the library name in its profile.
#include "apps/tandem/build/source_text.hpp"
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "host/opros/engine/profile/component_profile.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"
#include "host/plugin/find_library.hpp"

#include <algorithm>
#include <cctype>
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

// The profile of --profile, relative to the current folder or else to the component's; otherwise the only one.
engine::ComponentProfile select_profile(const OprosBuildOptions& options) {
    if (!options.profile.empty())
        return engine::read_component_profile(fs::exists(options.profile) ? fs::absolute(options.profile)
                                                                          : options.folder / options.profile);
    std::string error;
    const auto all = find_component_profiles(options.folder, error);
    if (all.size() == 1) return all.front();
    if (all.empty() && !error.empty()) throw std::runtime_error(error);
    if (all.empty())
        throw std::runtime_error("no component profile (XML with <component_profile>) in " +
                                 options.folder.string() +
                                 " nor in its profile/; name one with --profile FILE");
    std::string names;
    for (const auto& each : all)
        names += (names.empty() ? "" : ", ") + each.location.file.lexically_relative(options.folder).string();
    throw std::runtime_error(options.folder.string() + " has several component profiles: " + names +
                             "; name one with --profile FILE");
}

// The library's name without prefix and suffix: X.dll and libX.so become X. The host finds X.so under each of them.
std::string library_stem(const engine::ComponentProfile& profile) {
    const auto file = fs::path(profile.library_name).filename().string();
    auto stem = fs::path(plugin::library_file_names(file).back()).stem().stem().string();
    const auto allowed = [](unsigned char c) {
        return c < 128 && (std::isalnum(c) || std::strchr("_-+.", c) != nullptr);
    };
    // The stem becomes a CMake target and the name of a file.
    if (stem.empty() || !std::all_of(stem.begin(), stem.end(), allowed))
        throw engine::SetupError(profile.library_location,
                                 "no library can be built as '" + replace_nonprintable(stem) +
                                     "', expected letters, digits, and _ - + . of ASCII");
    return stem;
}

} // namespace

// Prints the path of the library and nothing else, for scripts.
int opros_build(const OprosBuildOptions& options) {
    require_folder(options.folder);
    const auto profile = select_profile(options);
    // Beside the profile, where opros_host looks first.
    const auto library = build_plugin("opros", library_stem(profile), "getComponent", options,
                                      profile.location.file.parent_path());
    print_text(library.string() + "\n");
    return 0;
}

} // namespace tandem::command
