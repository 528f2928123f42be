// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/cmake_commands.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

namespace tandem::command {
namespace {

// Bytes of expanded words: variables that contain each other multiply.
constexpr std::size_t max_expanded = 1 << 20;
constexpr int max_references = 100; // in a word

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

// Returns the place of the parenthesis that closes the one at `open`; npos if there is none.
std::size_t closing_parenthesis(const std::string& text, std::size_t open) {
    int depth = 0;
    bool quoted = false;
    for (auto at = open; at < text.size(); ++at) {
        if (text[at] == '\\')
            ++at;
        else if (text[at] == '"')
            quoted = !quoted;
        else if (!quoted && text[at] == '(')
            ++depth;
        else if (!quoted && text[at] == ')' && --depth == 0)
            return at;
    }
    return std::string::npos;
}

} // namespace

std::vector<CMakeCommand> read_commands(const std::filesystem::path& file) {
    std::string text;
    for (const auto& line : read_lines(file)) text += line + '\n';
    std::vector<CMakeCommand> commands;
    for (std::size_t open = 0; (open = text.find('(', open)) != std::string::npos;) {
        const auto end = open == 0 ? std::string::npos : text.find_last_not_of(" \t", open - 1);
        const auto close = closing_parenthesis(text, open);
        if (end == std::string::npos || close == std::string::npos) break;
        std::size_t begin = end + 1;
        while (begin > 0 &&
               (std::isalnum(static_cast<unsigned char>(text[begin - 1])) || text[begin - 1] == '_'))
            --begin;
        commands.push_back(
            {to_lower(text.substr(begin, end + 1 - begin)), text.substr(open + 1, close - open - 1)});
        open = close;
    }
    return commands;
}

Words expand(const Words& words, const Variables& variables) {
    Words all;
    std::size_t size = 0;
    for (std::string word : words) {
        Words values{word};
        int references = 0;
        for (auto found = find_variable_reference(word); !found.name.empty();
             found = find_variable_reference(word)) {
            const auto known = variables.find(found.name);
            values = known == variables.end() ? Words{} : known->second;
            if (values.size() != 1 || (found.begin == 0 && found.end == word.size())) break;
            if (++references > max_references || word.size() + values[0].size() > max_expanded) return all;
            word.replace(found.begin, found.end - found.begin, values[0]);
            values = {word};
        }
        for (auto& value : values) {
            if ((size += value.size() + 1) > max_expanded) return all;
            all.push_back(std::move(value));
        }
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

} // namespace tandem::command
