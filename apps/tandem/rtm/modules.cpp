// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/modules.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Returns identifiers and numbers as words, and every other non-blank character as a separate token.
std::vector<std::string> tokenize(const std::string& text) {
    std::vector<std::string> found;
    for (std::size_t i = 0; i < text.size();) {
        // ASCII characters of C++ identifiers. Other characters become tokens that match nothing below.
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

// Returns whether the tokens from `at` are the wanted ones.
bool matches_at(const std::vector<std::string>& all, std::size_t at,
                std::initializer_list<const char*> wanted) {
    if (at + wanted.size() > all.size()) return false;
    for (const char* each : wanted)
        if (all[at++] != each) return false;
    return true;
}

// Returns the implementation_id in a component's specification, or otherwise the file's name.
std::string implementation_id(const std::vector<std::string>& tokens, const fs::path& file) {
    for (std::size_t i = 0; i + 4 < tokens.size(); ++i)
        if (matches_at(tokens, i, {"implementation_id", "\"", ",", "\""})) return tokens[i + 4];
    return file.stem().string();
}

// Adds the modules of a file. Skips a source with main(), which is a program that tandem rtm build does not build.
void add_modules(const fs::path& file, std::map<std::string, Module>& modules) {
    const auto text = read_text(file);
    if (defines_main(text)) return;
    const auto all = tokenize(strip_comments(text));
    std::vector<Module> found_here;
    std::set<std::string> of_programs; // functions passed to the manager of a program
    for (std::size_t i = 1; i < all.size(); ++i) {
        // Matches void XInit(RTC::Manager* ...: a definition or a declaration, with or without extern "C".
        const std::string& word = all[i];
        if (all[i - 1] == "setModuleInitProc" && word == "(" && i + 1 < all.size())
            of_programs.insert(all[i + 1]);
        if (all[i - 1] != "void" || !matches_at(all, i + 1, {"(", "RTC", ":", ":", "Manager", "*"})) continue;
        if (word == "rtc_init" && is_source(file))
            found_here.push_back({implementation_id(all, file), word, file});
        else if (word.size() > 4 && word.ends_with("Init"))
            found_here.push_back(
                {word.substr(0, word.size() - 4), word, is_source(file) ? file : fs::path{}});
    }
    for (auto& module : found_here) {
        if (of_programs.count(module.function) != 0) continue;
        auto& known = modules.try_emplace(module.name, module).first->second;
        if (known.source.empty()) known.source = module.source;
    }
}

} // namespace

std::vector<Module> find_modules(const fs::path& folder) {
    std::map<std::string, Module> modules;
    for (const char* place : {"", "src", "include"})
        for (const auto& file : list_files(folder / place))
            if (is_source_or_header(file)) add_modules(file, modules);
    if (modules.empty())
        for (const auto& file : list_files_below(folder))
            if (is_source_or_header(file)) add_modules(file, modules);
    // A function that only a header declares may belong to a library that the component uses.
    const bool defined = std::any_of(modules.begin(), modules.end(),
                                     [](const auto& entry) { return !entry.second.source.empty(); });
    std::vector<Module> found;
    for (auto& [name, module] : modules)
        if (!defined || !module.source.empty()) found.push_back(std::move(module));
    return found;
}

} // namespace tandem::command
