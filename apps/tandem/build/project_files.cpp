// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/project_files.hpp"
#include "apps/tandem/build/source_text.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using Variables = std::map<std::string, Words>;

const std::string pattern_mark = "*"; // stands for the unknown files of a pattern

// Adds a word's file if it exists: a source, or the source of an object file.
void add_source(const fs::path& folder, const std::string& word, std::vector<fs::path>& sources) {
    const fs::path file = folder / to_posix_path(word);
    std::vector<fs::path> possible{file};
    if (file.extension() == ".o" || file.extension() == ".obj")
        for (const char* ending : {".cpp", ".cc", ".cxx", ".c"})
            possible.push_back(fs::path(file).replace_extension(ending));
    std::error_code ignored;
    for (const auto& each : possible)
        if (is_source(each) && fs::is_regular_file(each, ignored)) {
            sources.push_back(fs::weakly_canonical(each, ignored));
            return;
        }
}

void add_list(const fs::path& project_file, const Words& words, std::vector<SourceList>& lists) {
    SourceList list{project_file, {}};
    for (const auto& word : words) {
        if (word == pattern_mark) return;
        add_source(project_file.parent_path(), word, list.sources);
    }
    if (!list.sources.empty()) lists.push_back(std::move(list));
}

// A reference to a variable, ${NAME} or $(NAME), and its place in a word; without a name if there is none.
struct Reference {
    std::size_t begin, end;
    std::string name;
};
Reference find_reference(const std::string& word) {
    const auto begin = word.find('$');
    if (begin == std::string::npos || begin + 1 == word.size()) return {};
    const char open = word[begin + 1];
    const auto end = open == '{'   ? word.find('}', begin)
                     : open == '(' ? word.find(')', begin)
                                   : std::string::npos;
    if (end == std::string::npos) return {};
    return {begin, end + 1, word.substr(begin + 2, end - begin - 2)};
}

// The words with the variables' values. A word that is one reference may stand for several words or none; with an
// unknown part the whole word is unknown.
Words expand(const Words& words, const Variables& variables) {
    Words all;
    for (std::string word : words) {
        Words values{word};
        for (auto found = find_reference(word); !found.name.empty(); found = find_reference(word)) {
            const auto known = variables.find(found.name);
            values = known == variables.end() ? Words{} : known->second;
            if (values.size() != 1 || (found.begin == 0 && found.end == word.size())) break;
            word.replace(found.begin, found.end - found.begin, values[0]);
            values = {word};
        }
        all.insert(all.end(), values.begin(), values.end());
    }
    return all;
}

// Words between white space, quotes, ';' and ','.
Words split(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '"' || c == ';' || c == ','; }, ' ');
    std::istringstream stream(text);
    Words words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

// A makefile's or a CMakeLists.txt's lines without comments, with those joined that end in a backslash.
std::vector<std::string> read_lines(const fs::path& file) {
    std::istringstream stream(read_text(file));
    std::vector<std::string> lines;
    bool continued = false;
    for (std::string line; std::getline(stream, line);) {
        line = line.substr(0, line.find('#'));
        line.erase(line.find_last_not_of(" \t\r") + 1);
        const bool continues = !line.empty() && line.back() == '\\';
        if (continues) line.back() = ' ';
        if (continued)
            lines.back() += line;
        else
            lines.push_back(line);
        continued = continues;
    }
    return lines;
}

// The commands of a CMakeLists.txt: names in lower case, with the text between their parentheses.
std::vector<std::pair<std::string, std::string>> read_commands(const fs::path& file) {
    std::string text;
    for (const auto& line : read_lines(file)) text += line + '\n';
    std::vector<std::pair<std::string, std::string>> commands;
    for (std::size_t open = 0; (open = text.find('(', open)) != std::string::npos;) {
        const auto end = text.find_last_not_of(" \t", open - 1); // of the name, for open > 0
        const auto close = text.find(')', open);
        if (open == 0 || end == std::string::npos || close == std::string::npos) break;
        std::size_t begin = end + 1;
        while (begin > 0 &&
               (std::isalnum(static_cast<unsigned char>(text[begin - 1])) || text[begin - 1] == '_'))
            --begin;
        commands.emplace_back(to_lower(text.substr(begin, end + 1 - begin)),
                              text.substr(open + 1, close - open - 1));
        open = close;
    }
    return commands;
}

// A list for each target, from those commands that concern sources.
void read_cmake(const fs::path& file, std::vector<SourceList>& lists) {
    const std::set<std::string> targets{"add_library", "add_executable", "rtmbuild_add_library",
                                        "rtmbuild_add_executable", "rosbuild_add_library"};
    const auto folder = file.parent_path().string();
    Variables variables{{"CMAKE_CURRENT_SOURCE_DIR", {folder}}, {"PROJECT_SOURCE_DIR", {folder}}};
    for (const auto& [name, text] : read_commands(file)) {
        const Words words = expand(split(text), variables);
        if (words.empty()) continue;
        if (name == "project")
            variables["PROJECT_NAME"] = {words[0]};
        else if (name == "set")
            variables[words[0]] = Words(words.begin() + 1, words.end());
        else if (name == "list" && words.size() > 1 && words[0] == "APPEND")
            variables[words[1]].insert(variables[words[1]].end(), words.begin() + 2, words.end());
        else if (words.size() > 1 &&
                 (name == "aux_source_directory" || (name == "file" && words[0].rfind("GLOB", 0) == 0)))
            variables[words[1]] = {pattern_mark};
        else if (targets.count(name) != 0)
            add_list(file, words, lists);
    }
}

// Each variable of a makefile, with those that it refers to.
Variables read_make_variables(const fs::path& file) {
    Variables variables;
    for (const auto& line : read_lines(file)) {
        const auto equals = line.find('=');
        if (equals == std::string::npos || equals == 0) continue;
        const auto end = line.find_last_not_of(" \t:+?", equals - 1);
        const Words name = end == std::string::npos ? Words{} : split(line.substr(0, end + 1));
        if (name.size() != 1) continue;
        const std::string value = line.substr(equals + 1);
        const Words words = value.find("$(wildcard") != std::string::npos ? Words{pattern_mark}
                                                                          : expand(split(value), variables);
        // Added also when it is assigned again, which is mostly the branch of another platform.
        auto& all = variables[name[0]];
        all.insert(all.end(), words.begin(), words.end());
    }
    return variables;
}

bool is_makefile(const fs::path& file) {
    const auto name = to_lower(file.filename().string());
    return name.rfind("makefile", 0) == 0 && name.find(".in") == std::string::npos;
}

bool is_visual_project(const fs::path& file) {
    const auto ending = to_lower(file.extension().string());
    return ending == ".vcproj" || ending == ".vcxproj";
}

// Whether a file is left out of all configurations of a Visual C++ project.
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

// Names of files are ASCII in the encodings that these projects have, so that the bytes can be taken as they are.
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
            read_cmake(file, lists);
        else if (is_makefile(file)) {
            for (const auto& [name, words] : read_make_variables(file)) add_list(file, words, lists);
        } else if (is_visual_project(file))
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
        if (is_visual_project(file))
            for (const auto& dir : read_visual_project(file).include_dirs) add(dir);
        if (!is_makefile(file)) continue;
        for (const auto& [name, words] : read_make_variables(file))
            for (const auto& word : words)
                if (word.rfind("-I", 0) == 0) add(word.substr(2));
    }
    return dirs;
}

} // namespace tandem::command
