// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/module_names.hpp"

#include <cctype>
#include <fstream>
#include <sstream>
#include <vector>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Replaces comments by blanks. String literals are not recognized: a definition of a module function inside of
// one is not to be expected.
std::string strip_comments(std::string text) {
    // A state machine over pairs of characters; the last character cannot begin or end a comment.
    enum { code, line, block } in = code;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        if (in == code && text[i] == '/' && (text[i + 1] == '/' || text[i + 1] == '*'))
            in = text[i + 1] == '/' ? line : block;
        else if (in == line && text[i] == '\n')
            in = code;
        else if (in == block && text[i] == '*' && text[i + 1] == '/') {
            in = code;
            text[i + 1] = ' ';
        } else if (in == code)
            continue;
        text[i] = ' ';
    }
    return text;
}

// Identifiers and numbers as words, every other character but white space as a token of its own.
std::vector<std::string> tokenize(const std::string& text) {
    std::vector<std::string> found;
    for (std::size_t i = 0; i < text.size();) {
        // The characters of C++ identifiers in ASCII; others are tokens of their own, which match nothing below.
        const auto word = [&](std::size_t at) {
            return at < text.size() &&
                   (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_');
        };
        std::size_t end = i;
        while (word(end)) ++end;
        if (end == i && !std::isspace(static_cast<unsigned char>(text[i]))) end = i + 1;
        if (end > i) found.push_back(text.substr(i, end - i));
        i = std::max(end, i + 1);
    }
    return found;
}

// Whether the tokens from `at` on are the wanted ones.
bool matches_at(const std::vector<std::string>& all, std::size_t at,
                std::initializer_list<const char*> wanted) {
    if (at + wanted.size() > all.size()) return false;
    for (const char* each : wanted)
        if (all[at++] != each) return false;
    return true;
}

// Adds the modules that a source defines. A source with a main() is the component's own program, which tandem rtm build
// leaves out.
void add_names(const fs::path& file, std::set<std::string>& names) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    const auto all = tokenize(strip_comments(text.str()));
    // Gathered apart: main() may follow the module function, and then none of this file counts.
    std::set<std::string> found_here;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (matches_at(all, i, {"int", "main", "("})) return;
        // void XInit(RTC::Manager* ...: a definition or a declaration, with or without extern "C" before it.
        const std::string& word = all[i];
        if (word.size() > 4 && word.ends_with("Init") && i > 0 && all[i - 1] == "void" &&
            matches_at(all, i + 1, {"(", "RTC", ":", ":", "Manager", "*"}))
            found_here.insert(word.substr(0, word.size() - 4));
    }
    names.merge(found_here);
}

// IDL files and data are not read.
bool is_source(const fs::path& file) {
    static const std::set<std::string> endings{".h", ".hh", ".hpp", ".hxx", ".cpp", ".cc", ".cxx", ".c"};
    return endings.count(file.extension().string()) != 0;
}

} // namespace

std::set<std::string> find_module_names(const fs::path& folder) {
    std::set<std::string> names;
    std::error_code ignored;
    // A folder that is missing has no sources: the iterator is then at its end.
    for (const char* place : {"", "src", "include"})
        for (const auto& entry : fs::directory_iterator(folder / place, ignored))
            if (is_source(entry.path())) add_names(entry.path(), names);
    return names;
}

} // namespace tandem::command
