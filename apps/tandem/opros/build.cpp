// SPDX-License-Identifier: Apache-2.0
// tandem opros build: builds a component from its folder, under the library name in its profile.
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "host/opros/engine/profile/component_profile.hpp"
#include "host/plugin/find_library.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// The component profiles in the folder itself and where OPRoS's own tools put them. Other profiles are passed over.
std::vector<engine::ComponentProfile> find_component_profiles(const fs::path& folder) {
    std::vector<engine::ComponentProfile> found;
    for (const char* subfolder : {"", "profile", "profiles"}) {
        // A subfolder that does not exist has no profiles: the iterator is then at its end.
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(folder / subfolder, ignored)) {
            if (entry.path().extension() != ".xml") continue;
            try {
                found.push_back(engine::read_component_profile(entry.path()));
            } catch (const engine::SetupError&) {
                continue; // the profile of a service, a data type or an application
            }
        }
    }
    return found;
}

// The profile of --profile, otherwise the only one in the folder.
engine::ComponentProfile select_profile(const OprosBuildOptions& options) {
    if (!options.profile.empty()) return engine::read_component_profile(options.folder / options.profile);
    const auto all = find_component_profiles(options.folder);
    if (all.size() == 1) return all.front();
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
    const auto library =
        build_plugin("opros", library_stem(profile), options, profile.location.file.parent_path());
    print_text(library.string() + "\n");
    return 0;
}

} // namespace tandem::command
