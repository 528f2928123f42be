// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/project_files.hpp"
#include "apps/tandem/build/folder/autoconf.hpp"
#include "apps/tandem/build/folder/checkout.hpp"
#include "apps/tandem/build/folder/cmake_lists.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <algorithm>
#include <pugixml.hpp>
#include <string>
#include <utility>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

bool is_visual_studio_project(const fs::path& file) {
    const auto ending = to_lower(file.extension().string());
    return ending == ".vcproj" || ending == ".vcxproj";
}

// Adds the file that a word names, if the file exists: a source, or the source of an object file.
void add_source(const fs::path& folder, const std::string& word, std::vector<fs::path>& sources) {
    const fs::path file = folder / to_posix_path(word);
    std::vector<fs::path> possible{file};
    if (file.extension() == ".o" || file.extension() == ".obj")
        for (const char* ending : {".cpp", ".cc", ".cxx", ".c"})
            possible.push_back(fs::path(file).replace_extension(ending));
    std::error_code ignored;
    for (const auto& each : possible)
        if (is_source(each) && is_file(each)) {
            sources.push_back(fs::weakly_canonical(each, ignored));
            return;
        }
}

void add_list(const fs::path& project_file, const Words& words, std::vector<SourceList>& lists,
              bool is_program = false) {
    SourceList list{project_file, {}, is_visual_studio_project(project_file), is_program};
    for (const auto& word : words) {
        if (word == unknown_files) return;
        add_source(project_file.parent_path(), word, list.sources);
    }
    if (!list.sources.empty()) lists.push_back(std::move(list));
}

// Returns the variables of a makefile with references to other variables expanded.
Variables read_make_variables(const fs::path& file) {
    Variables variables;
    for (const auto& line : read_lines(file)) {
        const auto equals = line.find('=');
        if (equals == std::string::npos || equals == 0) continue;
        const auto end = line.find_last_not_of(" \t:+?", equals - 1);
        const Words name = end == std::string::npos ? Words{} : split(line.substr(0, end + 1));
        if (name.size() != 1) continue;
        const std::string value = line.substr(equals + 1);
        const Words words = value.find("$(wildcard") != std::string::npos ? Words{unknown_files}
                                                                          : expand(split(value), variables);
        // A second assignment adds values, because it mostly belongs to the branch of another platform.
        auto& all = variables[name[0]];
        all.insert(all.end(), words.begin(), words.end());
    }
    return variables;
}

bool is_makefile(const fs::path& file) {
    const auto name = to_lower(file.filename().string());
    return name.rfind("makefile", 0) == 0 && !name.ends_with(".in");
}

// Returns whether all configurations of a Visual C++ project exclude a file.
bool is_excluded(const pugi::xml_node& file) {
    int configurations = 0, excluded = 0;
    for (const auto& each : file.children("FileConfiguration")) {
        ++configurations;
        excluded += to_lower(each.attribute("ExcludedFromBuild").value()) == "true";
    }
    return configurations > 0 && excluded == configurations;
}

struct VisualFileReader : pugi::xml_tree_walker {
    Words sources, include_dirs;
    bool for_each(pugi::xml_node& node) override {
        const std::string name = node.name();
        if (name == "File" && !is_excluded(node)) sources.push_back(node.attribute("RelativePath").value());
        if (name == "ClCompile") sources.push_back(node.attribute("Include").value());
        const std::string dirs = name == "AdditionalIncludeDirectories"
                                     ? node.text().get()
                                     : node.attribute("AdditionalIncludeDirectories").value();
        for (const auto& dir : split(dirs)) include_dirs.push_back(dir);
        return true;
    }
};

// Takes the bytes as they are: in the encodings of these projects, file names are ASCII.
VisualFileReader read_visual_project(const fs::path& file) {
    VisualFileReader reader;
    pugi::xml_document document;
    const auto text = read_text(file);
    if (document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8))
        document.traverse(reader);
    return reader;
}

} // namespace

std::vector<SourceList> read_source_lists(const fs::path& folder) {
    std::vector<SourceList> lists;
    for (const auto& file : list_files(folder)) {
        if (file.filename() == "CMakeLists.txt")
            for (const auto& target : read_cmake_lists(folder).targets)
                add_list(file, target.words, lists, target.is_program);
        else if (is_makefile(file)) {
            for (const auto& [name, words] : read_make_variables(file)) add_list(file, words, lists);
        } else if (is_visual_studio_project(file))
            add_list(file, read_visual_project(file).sources, lists);
    }
    return lists;
}

std::vector<fs::path> read_include_dirs(const fs::path& folder) {
    std::vector<fs::path> dirs;
    const auto add = [&](const std::string& word) {
        std::error_code ignored;
        const auto dir = fs::weakly_canonical(folder / to_posix_path(word), ignored);
        if (!word.empty() && fs::is_directory(dir, ignored)) dirs.push_back(dir);
    };
    for (const auto& file : list_files(folder)) {
        if (is_visual_studio_project(file))
            for (const auto& dir : read_visual_project(file).include_dirs) add(dir);
        if (!is_makefile(file)) continue;
        for (const auto& [name, words] : read_make_variables(file))
            for (const auto& word : words)
                if (word.rfind("-I", 0) == 0) add(word.substr(2));
    }
    return dirs;
}

std::vector<std::string> read_definitions(const fs::path& folder) {
    auto ancestors = ancestors_in_checkout(folder);
    for (auto at = ancestors.rbegin(); at != ancestors.rend(); ++at) {
        if (is_file(*at / "CMakeLists.txt")) return read_cmake_lists(folder).definitions;
        for (const char* name : {"configure.ac", "configure.in"})
            if (is_file(*at / name)) return read_autoconf_definitions(*at / name);
    }
    return {};
}

} // namespace tandem::command
