// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/select_sources.hpp"
#include "apps/tandem/build/folder/project_files.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <algorithm>
#include <fnmatch.h>
#include <set>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

Paths filter(const Paths& files, const std::string& function) {
    Paths found;
    for (const auto& file : files)
        if (is_source(file) && defines_function(read_text(file), function)) found.push_back(file);
    return found;
}

void add_sources(const fs::path& folder, Paths& sources) {
    for (const auto& file : list_files(folder))
        if (is_source(file) && std::find(sources.begin(), sources.end(), file) == sources.end())
            sources.push_back(file);
}

bool matches(const fs::path& file, const fs::path& folder, const std::string& pattern) {
    const auto relative = file.lexically_relative(folder).string();
    return fnmatch(pattern.c_str(), relative.c_str(), 0) == 0 ||
           fnmatch(pattern.c_str(), file.filename().c_str(), 0) == 0 ||
           fs::absolute(pattern).lexically_normal() == file;
}

// Finds the named files: relative to the current folder, or to the component's folder, or as a pattern in the
// latter.
Paths named_sources(const fs::path& folder, const std::vector<std::string>& names) {
    Paths sources;
    for (const auto& name : names) {
        const auto here = fs::absolute(name).lexically_normal(), there = (folder / name).lexically_normal();
        if (is_file(here) || is_file(there)) {
            sources.push_back(is_file(here) ? here : there);
            continue;
        }
        const auto before = sources.size();
        for (const auto& file : list_files_below(folder))
            if (is_source(file) && matches(file, folder, name)) sources.push_back(file);
        if (sources.size() == before)
            throw std::runtime_error("--source " + name + ": no such file here or in " + folder.string());
    }
    return sources;
}

// Returns whether a pattern of --exclude means the file. A pattern that is the path of a source means only that one.
bool is_excluded(const fs::path& file, const fs::path& folder, const std::string& pattern,
                 const Paths& sources) {
    const auto there = (folder / pattern).lexically_normal();
    const auto here = fs::absolute(pattern).lexically_normal();
    const auto is_path = [&](const auto& source) { return source == there || source == here; };
    if (std::any_of(sources.begin(), sources.end(), is_path)) return is_path(file);
    return matches(file, folder, pattern);
}

void remove_excluded(const fs::path& folder, const std::vector<std::string>& excluded, Paths& sources) {
    for (const auto& pattern : excluded) {
        const auto all = sources;
        std::erase_if(sources, [&](const auto& source) { return is_excluded(source, folder, pattern, all); });
        if (sources.size() == all.size())
            throw std::runtime_error("--exclude " + pattern + ": no source file in " + folder.string() +
                                     " matches");
    }
}

std::string names_of(const Paths& files, const fs::path& folder) {
    std::string names;
    for (const auto& file : files)
        names += (names.empty() ? "" : ", ") + file.lexically_relative(folder).string();
    return names;
}

// Returns the given source of the entry point, or else all sources that define it.
Paths entries_of(const Paths& files, const EntryPoint& entry_point) {
    if (entry_point.source.empty()) return filter(files, entry_point.function);
    return {fs::weakly_canonical(entry_point.source)};
}

// Removes the sources of the folder's other components.
void remove_others(const Paths& entries, const EntryPoint& entry_point, Paths& sources) {
    Paths others = entry_point.source.empty() ? Paths{} : filter(sources, entry_point.function);
    for (const auto& function : entry_point.others)
        for (const auto& file : filter(sources, function)) others.push_back(file);
    std::erase_if(sources, [&](const auto& source) {
        const auto is_source = [&](const auto& other) { return other == source; };
        return std::any_of(others.begin(), others.end(), is_source) &&
               std::none_of(entries.begin(), entries.end(), is_source);
    });
}

// Uses the sources that a target lists. A program is the component's only target in some projects: its main() stays out.
void use_list(Paths listed, bool is_program, const std::string& project_files, SelectedSources& selected) {
    if (is_program) std::erase_if(listed, [](const auto& file) { return defines_main(read_text(file)); });
    for (const auto& source : selected.sources)
        if (std::find(listed.begin(), listed.end(), source) == listed.end())
            selected.left_out.push_back(source);
    selected.sources = std::move(listed);
    selected.project_files = project_files;
}

template <class Condition>
void remove_unless_all(std::vector<SourceList>& lists, Condition condition) {
    if (!std::all_of(lists.begin(), lists.end(), condition)) std::erase_if(lists, condition);
}

// Uses the sources that project files list together with a source that defines the entry point.
void apply_source_lists(const fs::path& folder, const Paths& entries, SelectedSources& selected) {
    std::set<fs::path> places{folder, folder / "src"};
    for (const auto& entry : entries) places.insert(entry.parent_path());
    std::vector<SourceList> lists;
    for (const auto& place : places)
        for (const auto& list : read_source_lists(place))
            if (std::any_of(list.sources.begin(), list.sources.end(), [&](const auto& source) {
                    return std::find(entries.begin(), entries.end(), source) != entries.end();
                }))
                lists.push_back(list);
    // Projects of Visual C++ also list sources for Windows, and programs sources with main().
    remove_unless_all(lists, [](const auto& list) { return list.for_windows; });
    remove_unless_all(lists, [](const auto& list) { return list.is_program; });
    Paths listed, project_files;
    const auto add = [](Paths& all, const fs::path& file) {
        if (std::find(all.begin(), all.end(), file) == all.end()) all.push_back(file);
    };
    for (const auto& list : lists) {
        add(project_files, list.project_file);
        for (const auto& source : list.sources) add(listed, source);
    }
    const bool is_program = !lists.empty() && lists.front().is_program; // then all are
    if (!listed.empty()) use_list(std::move(listed), is_program, names_of(project_files, folder), selected);
}

bool find_target(const Paths& entries, const fs::path& folder, const ProjectSearch& search,
                 ProjectTarget& target) {
    auto found = search.projects.find_target(folder, entries, search.name);
    if (found) target = std::move(*found);
    return found.has_value();
}

} // namespace

SelectedSources select_sources(const fs::path& named_folder, const EntryPoint& entry_point,
                               const SourceOptions& options, const ProjectSearch& search) {
    // Canonical, so that "../x.cpp" in a project file has the same path as x.cpp in the folder.
    const fs::path folder = fs::canonical(named_folder);
    SelectedSources selected;
    if (!options.sources.empty()) {
        selected.sources = named_sources(folder, options.sources);
        find_target(filter(selected.sources, entry_point.function), folder, search, selected.target);
    } else {
        add_sources(folder, selected.sources);
        add_sources(folder / "src", selected.sources);
        auto entries = entries_of(selected.sources, entry_point);
        if (entries.empty()) entries = entries_of(list_files_below(folder), entry_point);
        for (const auto& entry : entries) add_sources(entry.parent_path(), selected.sources);
        if (find_target(entries, folder, search, selected.target)) {
            use_list(selected.target.sources, selected.target.kind == ProjectTarget::Kind::program,
                     "CMakeLists.txt", selected);
        } else {
            remove_others(entries, entry_point, selected.sources);
            apply_source_lists(folder, entries, selected);
        }
    }
    remove_excluded(folder, options.excluded, selected.sources);
    if (selected.sources.empty())
        throw std::runtime_error("no C++ source in " + named_folder.string() +
                                 " or its src/; if the sources are elsewhere, name them with --source FILE");
    const auto entries = filter(selected.sources, entry_point.function);
    if (entries.size() > 1)
        throw std::runtime_error(
            names_of(entries, folder) + " each define " + entry_point.function +
            "(), but a library defines it once; leave out the other files with --exclude FILE");
    return selected;
}

} // namespace tandem::command
