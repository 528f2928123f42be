// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/packages/installed_library.hpp"
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/build/packages/header_packages.hpp"

#include <fstream>
#include <set>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

// Returns the folders that the compiler searches.
Paths include_folders(const fs::path& root) {
    Paths folders{root / "usr/include", root / "usr/local/include"};
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(root / "usr/include", ignored))
        if (entry.path().filename().string().ends_with("-linux-gnu")) folders.push_back(entry.path());
    return folders;
}

// Returns the only folder in an include folder that has the header; "" if there is none or if there are several.
fs::path only_folder_with(const std::string& header, const Paths& folders) {
    std::set<fs::path> found;
    std::error_code ignored;
    for (const auto& folder : folders)
        for (const auto& entry : fs::directory_iterator(folder, ignored))
            if (is_file(entry.path() / header)) found.insert(entry.path());
    return found.size() == 1 ? *found.begin() : fs::path{};
}

Paths shared_libraries(const Paths& files) {
    Paths libraries;
    for (const auto& file : files)
        if (file.extension() == ".so" && file.filename().string().starts_with("lib") && is_file(file))
            libraries.push_back(file);
    return libraries;
}

} // namespace

std::optional<InstalledLibrary> find_installed_library(const std::string& header, const fs::path& root) {
    const auto folders = include_folders(root);
    if (const auto package = find_package_of_header(header))
        for (const auto& folder : folders) {
            const auto dir = (folder / package->folder).lexically_normal();
            if (package->folder == "." || !is_file(dir / header)) continue;
            const bool has_module = !package->pkg_config.empty();
            return InstalledLibrary{dir, std::string(package->package), std::string(package->pkg_config),
                                    has_module ? Paths{}
                                               : shared_libraries(installed_files(package->package, root))};
        }
    // A name without a folder may be any header's.
    if (header.find('/') == std::string::npos) return std::nullopt;
    const auto dir = only_folder_with(header, folders);
    if (dir.empty()) return std::nullopt;
    return InstalledLibrary{dir, "", "", {}};
}

std::optional<InstalledLibrary>
find_installed_beside(const std::string& header, const std::set<std::string>& names, const fs::path& root) {
    if (header.find('/') != std::string::npos) return std::nullopt;
    for (const auto& name : names) {
        if (name.find('/') != std::string::npos) continue;
        auto library = find_installed_library(name, root);
        if (library && is_file(library->include_dir / header)) return library;
    }
    return std::nullopt;
}

Paths installed_files(std::string_view package, const fs::path& root) {
    const auto folder = root / "var/lib/dpkg/info";
    Paths files;
    // dpkg adds the architecture to the names of packages that can be installed for several.
    for (const char* architecture : {"", ":amd64", ":arm64"}) {
        std::ifstream list(folder / (std::string(package) + architecture + ".list"));
        for (std::string line; std::getline(list, line);)
            files.push_back(root / fs::path(line).relative_path());
    }
    return files;
}

} // namespace tandem::command
