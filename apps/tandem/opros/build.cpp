// SPDX-License-Identifier: Apache-2.0
// tandem opros build: builds a component from its folder, under the library name in its profile.
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/component_profiles.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "host/plugin/find_library.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Returns the library's name without prefix and suffix: X for X.dll and libX.so. The host finds X.so for each of them.
std::string library_stem(const engine::ComponentProfile& profile) {
    const auto file = fs::path(profile.library_name).filename().string();
    auto stem = fs::path(plugin::library_file_names(file).back()).stem().stem().string();
    const auto allowed = [](unsigned char c) {
        return c < 128 && (std::isalnum(c) || std::strchr("_-+.", c) != nullptr);
    };
    // The stem becomes a CMake target and a file name.
    if (stem.empty() || !std::all_of(stem.begin(), stem.end(), allowed))
        throw engine::SetupError(profile.library_location,
                                 "invalid library name '" + replace_nonprintable(stem) +
                                     "': expected ASCII letters, digits, and _ - + .");
    return stem;
}

} // namespace

// Prints only the path of the library, for scripts.
int opros_build(const OprosBuildOptions& options) {
    require_folder(options.folder);
    const auto profile = select_component_profile(options.folder, options.profile);
    CMakeProjects projects(projects_folder(options), options.timeout_s);
    // Beside the profile, where opros_host looks first.
    const auto library = build_plugin("opros", library_stem(profile), {"getComponent"}, options,
                                      profile.location.file.parent_path(), projects);
    print_data(library.string() + "\n");
    return 0;
}

} // namespace tandem::command
