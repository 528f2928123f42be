// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/module_names.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <cctype>
#include <vector>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

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
    const auto all = tokenize(strip_comments(read_text(file)));
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

} // namespace

std::set<std::string> find_module_names(const fs::path& folder) {
    std::set<std::string> names;
    for (const char* place : {"", "src", "include"})
        for (const auto& file : list_files(folder / place))
            if (is_source_or_header(file)) add_names(file, names);
    if (names.empty())
        for (const auto& file : list_files_below(folder))
            if (is_source_or_header(file)) add_names(file, names);
    return names;
}

} // namespace tandem::command
