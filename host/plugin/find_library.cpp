// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/find_library.hpp"

#include "host/plugin/error.hpp"

#include <algorithm>
#include <cctype>

namespace tandem::plugin {
namespace {

// Suffixes of Windows file names may be in upper case.
bool strip_suffix(std::string& name, const std::string& suffix) {
    if (name.size() <= suffix.size()) return false;
    const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
    if (!std::equal(name.end() - static_cast<std::ptrdiff_t>(suffix.size()), name.end(), suffix.begin(),
                    same))
        return false;
    name.resize(name.size() - suffix.size());
    return true;
}

std::string joined(const std::vector<std::string>& items) {
    std::string text;
    for (const std::string& item : items) text += (text.empty() ? "" : ", ") + item;
    return text;
}

void add_once(std::vector<std::string>& items, const std::string& item) {
    if (std::find(items.begin(), items.end(), item) == items.end()) items.push_back(item);
}

[[noreturn]] void throw_not_found(const std::string& name, const std::vector<std::filesystem::path>& dirs) {
    const std::string message =
        "library '" + name + "' not found: looked for " + joined(library_file_names(name));
    if (std::filesystem::path(name).is_absolute()) throw Error(Reason::not_found, message);
    std::vector<std::string> folders;
    for (const auto& dir : dirs) add_once(folders, dir.empty() ? "." : dir.string());
    throw Error(Reason::not_found, message + " in " + (folders.empty() ? "no folder" : joined(folders)));
}

} // namespace

std::vector<std::string> library_file_names(const std::string& name) {
    const std::filesystem::path path(name);
    std::string base = path.filename().string();
    while (strip_suffix(base, ".so") || strip_suffix(base, ".dll")) {
    }
    const std::string folder = path.has_parent_path() ? path.parent_path().string() + "/" : "";
    std::vector<std::string> names{name, folder + base + ".so", folder + "lib" + base + ".so",
                                   folder + "lib" + base + ".dll.so", folder + base + ".dll.so"};
    // The name itself is a candidate only if it ends in .so: X.dll is the file of a Windows library.
    if (name.size() < 3 || name.compare(name.size() - 3, 3, ".so") != 0) names.erase(names.begin());
    std::vector<std::string> unique;
    for (const std::string& candidate : names) add_once(unique, candidate);
    return unique;
}

std::filesystem::path find_library(const std::string& name,
                                   const std::vector<std::filesystem::path>& search_dirs) {
    const auto candidates = library_file_names(name);
    const bool absolute = std::filesystem::path(name).is_absolute();
    const auto dirs = absolute ? std::vector<std::filesystem::path>{""} : search_dirs;
    std::error_code ignored;
    if (!name.empty())
        for (const auto& dir : dirs)
            for (const std::string& candidate : candidates)
                if (auto file = dir / candidate; std::filesystem::is_regular_file(file, ignored)) return file;
    throw_not_found(name, dirs);
}

} // namespace tandem::plugin
