// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/checkout.hpp"
#include "apps/tandem/build/folder/cmake_commands.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <algorithm>
#include <iterator>
#include <regex>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

bool ends_with_path(const fs::path& file, const fs::path& end) {
    const auto length = std::distance(end.begin(), end.end()),
               whole = std::distance(file.begin(), file.end());
    return whole >= length && std::equal(end.begin(), end.end(), std::next(file.begin(), whole - length));
}

// Keeps one file per content, because repositories contain copies of the same header beside each component.
Paths distinct(const Paths& files) {
    Paths found;
    for (const auto& file : files) {
        const auto text = read_text(file);
        if (std::none_of(found.begin(), found.end(),
                         [&](const auto& other) { return read_text(other) == text; }))
            found.push_back(file);
    }
    return found;
}

// Returns the sources that define members of the class or use its static ones. None for a class in a function or template,
// which has no plain name.
Paths with_members_of(const Paths& files, const std::string& name) {
    static const std::regex plain_name("(?:\\w+::)*(\\w+)");
    std::smatch names;
    if (!std::regex_match(name, names, plain_name)) return {};
    const std::regex member("\\b" + names[1].str() + "::");
    Paths found;
    for (const auto& file : files)
        if (is_source(file) && std::regex_search(strip_comments(read_text(file)), member))
            found.push_back(file);
    return distinct(found);
}

} // namespace

fs::path find_checkout(const fs::path& folder) {
    std::error_code ignored;
    const auto whole = fs::weakly_canonical(folder, ignored);
    for (auto at = whole; at != at.root_path(); at = at.parent_path())
        for (const char* mark : {".git", ".hg", ".svn"})
            if (fs::exists(at / mark, ignored)) return at;
    return {};
}

Paths ancestors_in_checkout(const fs::path& folder) {
    std::error_code ignored;
    Paths folders{fs::weakly_canonical(folder, ignored)};
    const auto checkout = find_checkout(folder);
    while (!checkout.empty() && folders.front() != checkout)
        folders.insert(folders.begin(), folders.front().parent_path());
    return folders;
}

bool has_upstream_api(const fs::path& folder) {
    const auto has = [&](const char* file) { return is_file(folder / file); };
    return has("Component.h") || has("OPRoSTypes.h") || has("rtm/Manager.h") ||
           has("DataFlowComponentBase.h");
}

Paths find_in_checkout(const fs::path& checkout, const std::string& name) {
    if (checkout.empty()) return {};
    fs::path end = fs::path(to_posix_path(name)).lexically_normal();
    while (!end.empty() && (*end.begin() == ".." || end.is_absolute()))
        end = end.lexically_relative(*end.begin());
    const auto all = list_files_below(checkout);
    for (; !end.empty() && end != "."; end = end.lexically_relative(*end.begin())) {
        Paths found;
        std::copy_if(all.begin(), all.end(), std::back_inserter(found), [&](const auto& file) {
            return (is_source_or_header(file) || is_idl(file)) && ends_with_path(file, end) &&
                   !has_upstream_api(file.parent_path());
        });
        if (!found.empty()) return distinct(found);
    }
    return {};
}

Paths find_definitions(const Paths& files, const std::string& symbol) {
    // The compiler emits it with the members of the class.
    if (const std::string of_class = "vtable for "; symbol.rfind(of_class, 0) == 0)
        return with_members_of(files, symbol.substr(of_class.size()));
    static const std::regex last_names("((?:\\w+::)?~?(\\w+))$");
    std::smatch names;
    const auto plain = symbol.substr(0, symbol.find('('));
    if (!std::regex_search(plain, names, last_names)) return {};
    // Members have their class before the name; functions do not have their namespace.
    for (const auto& name : {names[1].str(), names[2].str()}) {
        Paths found;
        for (const auto& file : files)
            if (is_source(file) && defines_function(read_text(file), name)) found.push_back(file);
        if (!found.empty()) return distinct(found);
    }
    return {};
}

std::vector<std::string> missing_submodules(const fs::path& checkout) {
    static const std::regex entry("\\s*path\\s*=\\s*(\\S.*?)\\s*");
    std::vector<std::string> missing;
    for (const auto& line : read_lines(checkout / ".gitmodules")) {
        std::smatch found;
        std::error_code ignored;
        if (std::regex_match(line, found, entry) &&
            fs::directory_iterator(checkout / found[1].str(), ignored) == fs::directory_iterator())
            missing.push_back(found[1]);
    }
    return missing;
}

Paths folders_with(const fs::path& component_folder, const std::string& header) {
    std::error_code ignored;
    Paths possible;
    const auto checkout = find_checkout(component_folder);
    for (auto file : find_in_checkout(checkout.empty() ? component_folder : checkout, header)) {
        for (const auto& part : fs::path(header)) file = part == ".." ? file : file.parent_path();
        possible.push_back(file);
    }
    const auto parent = fs::weakly_canonical(component_folder, ignored).parent_path();
    if (checkout.empty() && parent != parent.root_path())
        for (const auto& entry : fs::directory_iterator(parent, ignored))
            for (const auto& dir : {entry.path(), entry.path() / "include", entry.path() / "src"})
                possible.push_back(dir);
    Paths found;
    for (const auto& dir : possible)
        if (is_file(dir / header)) found.push_back(dir);
    return found;
}

} // namespace tandem::command
