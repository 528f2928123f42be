// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/cmake_lists.hpp"

#include "apps/tandem/build/folder/checkout.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <utility>

namespace tandem::command {
namespace {

// A reference to a variable, ${NAME} or $(NAME), and its place in a word. `name` is empty if there is none.
struct Reference {
    std::size_t begin, end;
    std::string name;
};
Reference find_variable_reference(const std::string& word) {
    const auto begin = word.find('$');
    if (begin == std::string::npos || begin + 1 == word.size()) return {};
    const char open = word[begin + 1];
    const auto end = open == '{'   ? word.find('}', begin)
                     : open == '(' ? word.find(')', begin)
                                   : std::string::npos;
    if (end == std::string::npos) return {};
    return {begin, end + 1, word.substr(begin + 2, end - begin - 2)};
}

namespace fs = std::filesystem;

// Returns the commands of a CMakeLists.txt: names in lower case, with the text between their parentheses.
std::vector<std::pair<std::string, std::string>> read_commands(const fs::path& file) {
    std::string text;
    for (const auto& line : read_lines(file)) text += line + '\n';
    std::vector<std::pair<std::string, std::string>> commands;
    for (std::size_t open = 0; (open = text.find('(', open)) != std::string::npos;) {
        const auto end = text.find_last_not_of(" \t", open - 1); // end of the name, for open > 0
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

// Applies set(), project() and list(APPEND).
void read_cmake_variables(const std::string& command, const Words& words, Variables& variables) {
    if (command == "project")
        variables["PROJECT_NAME"] = {words[0]};
    else if (command == "set")
        variables[words[0]] = Words(words.begin() + 1, std::find(words.begin() + 1, words.end(), "CACHE"));
    else if (command == "list" && words.size() > 1 && words[0] == "APPEND")
        variables[words[1]].insert(variables[words[1]].end(), words.begin() + 2, words.end());
}

// Returns NAME or NAME=VALUE from an argument of add_definitions(). Removes the escapes of a string literal's
// quotes for CMake and the shell. Returns "" for another option.
std::string to_definition(const std::string& word) {
    const auto unescaped = [](std::string text) {
        text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == '"' || c == '\\'; }),
                   text.end());
        return text;
    };
    const auto equals = word.find('=');
    const std::string name = unescaped(word.substr(0, equals));
    if (name.rfind("-D", 0) != 0 || name.size() == 2) return "";
    if (equals == std::string::npos) return name.substr(2);
    const std::string value = word.substr(equals + 1);
    const bool literal = value.rfind('"', 0) == 0 || value.rfind("\\\"", 0) == 0;
    return name.substr(2) + "=" + (literal ? '"' + unescaped(value) + '"' : unescaped(value));
}

// Reads the definitions of one CMakeLists.txt. The files in its sub-folders inherit `variables`.
void read_cmake_definitions(const fs::path& file, Variables& variables, Words& definitions) {
    const std::set<std::string> begins{"if", "foreach", "while", "function", "macro"},
        ends{"endif", "endforeach", "endwhile", "endfunction", "endmacro"};
    int depth = 0;
    for (const auto& [name, text] : read_commands(file)) {
        depth += static_cast<int>(begins.count(name)) - static_cast<int>(ends.count(name));
        const Words words = expand(split(text), variables);
        if (!words.empty()) read_cmake_variables(name, words, variables);
        if (name != "add_definitions" || depth > 0) continue;
        std::istringstream arguments(text);
        for (std::string word; arguments >> word;)
            for (const auto& each : expand({word}, variables))
                if (const auto definition = to_definition(each); !definition.empty())
                    definitions.push_back(definition);
    }
}

} // namespace

Words expand(const Words& words, const Variables& variables) {
    Words all;
    for (std::string word : words) {
        Words values{word};
        for (auto found = find_variable_reference(word); !found.name.empty();
             found = find_variable_reference(word)) {
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

Words split(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '"' || c == ';' || c == ','; }, ' ');
    std::istringstream stream(text);
    Words words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

std::vector<std::string> read_lines(const std::filesystem::path& file) {
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

std::vector<Words> read_cmake_targets(const fs::path& file) {
    std::vector<Words> lists;
    const std::set<std::string> targets{"add_library", "add_executable", "rtmbuild_add_library",
                                        "rtmbuild_add_executable", "rosbuild_add_library"};
    const auto folder = file.parent_path().string();
    Variables variables{{"CMAKE_CURRENT_SOURCE_DIR", {folder}}, {"PROJECT_SOURCE_DIR", {folder}}};
    for (const auto& [name, text] : read_commands(file)) {
        const Words words = expand(split(text), variables);
        if (words.empty()) continue;
        read_cmake_variables(name, words, variables);
        if (words.size() > 1 &&
            (name == "aux_source_directory" || (name == "file" && words[0].rfind("GLOB", 0) == 0)))
            variables[words[1]] = {unknown_files};
        else if (targets.count(name) != 0)
            lists.push_back(words);
    }
    return lists;
}

std::vector<std::string> read_definitions(const fs::path& folder) {
    Variables variables;
    Words definitions;
    for (const auto& each : ancestors_in_checkout(folder))
        read_cmake_definitions(each / "CMakeLists.txt", variables, definitions);
    return definitions;
}

} // namespace tandem::command
