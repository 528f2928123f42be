// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/project_text.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <algorithm>
#include <sstream>

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

} // namespace tandem::command
