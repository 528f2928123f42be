// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/first_error.hpp"

#include <algorithm>
#include <iterator>
#include <regex>
#include <sstream>
#include <string_view>
#include <utility>

namespace tandem::command {
namespace {

// Returns an error of CMake in one line. CMake prints the place, then the indented and wrapped text, then an
// empty line.
std::string cmake_error(std::string text, std::istream& lines) {
    for (std::string line; std::getline(lines, line) && line.rfind("  ", 0) == 0;)
        text += line.substr(1); // keeps one of the two spaces as separator
    return text;
}

// Returns whether the line is "FILE:LINE: TEXT", as omniidl reports an error. The lines that omniidl adds to an error or
// a warning have a blank before the text. Compilers also print the column.
bool is_located_error(const std::string& line) {
    const auto number = line.find(':') + 1; // 0 if there is none
    const auto end = line.find_first_not_of("0123456789", number);
    if (number < 2 || end == std::string::npos || end == number || line.compare(end, 2, ": ") != 0)
        return false;
    const auto text = std::string_view(line).substr(end + 2);
    return !text.starts_with(' ') && !text.starts_with("Warning: ") && !text.starts_with("warning: ");
}

/// Replaces the text around a name: BEFORE, name, AFTER becomes OPEN, name, CLOSE. Returns the name; "" if it is not there.
std::string reword(std::string& line, const std::string& before, const std::string& after,
                   const std::string& open, const std::string& close) {
    auto name = between(line, before, after);
    if (!name.empty())
        line.replace(line.find(before), before.size() + name.size() + after.size(), open + name + close);
    return name;
}

/// Returns whether a standard header of this name declares the name. clang does not say which header is missing.
bool is_header_of_its_name(const std::string& name) {
    static const char* const headers[] = {"array", "bitset",  "deque",    "forward_list",  "list",
                                          "map",   "mutex",   "optional", "queue",         "set",
                                          "span",  "stack",   "string",   "string_view",   "thread",
                                          "tuple", "variant", "vector",   "unordered_map", "unordered_set"};
    return std::find(std::begin(headers), std::end(headers), name) != std::end(headers);
}

std::string worded_as_gcc(std::string line) {
    reword(line, "fatal error: '", "' file not found", "fatal error: ", ": No such file or directory");
    reword(line, "error: unknown type name '", "'", "error: '", "' does not name a type");
    reword(line, "error: use of undeclared identifier '", "'", "error: '",
           "' was not declared in this scope");
    reword(line, "error: undefined symbol: ", "\n", "error: undefined reference to `", "'\n");
    reword(line, "error: unable to find library -l", "\n", "error: cannot find -l", "\n");
    for (const std::string kind : {"member", "type", "template"}) {
        const auto name = reword(line, "error: no " + kind + " named '", "' in namespace 'std'", "error: '",
                                 "' is not a member of 'std'");
        if (is_header_of_its_name(name))
            line.insert(line.find_last_not_of('\n') + 1, "; did you forget to '#include <" + name + ">'?");
    }
    return line;
}

bool is_from_make(const std::string& line) {
    return line.rfind("gmake", 0) == 0 || line.rfind("make", 0) == 0;
}

} // namespace

// Later errors of a compiler are mostly consequences of the first one.
std::string first_error(const std::string& output) {
    std::istringstream lines(output);
    std::string line, last;
    while (std::getline(lines, line)) {
        if (line.find("CMake Error at ") != std::string::npos) return cmake_error(line, lines);
        for (const char* word : {"error: ", "undefined reference", "multiple definition", "CMake Error",
                                 "undefined symbol", ": No such file or directory"})
            if (line.find(word) != std::string::npos) return line;
        if (is_located_error(line)) return line;
        if (line.find_first_not_of(" \t") != std::string::npos && !is_from_make(line)) last = line;
    }
    return last;
}

std::string output_worded_as_gcc(const std::string& output) {
    std::istringstream lines(output);
    std::string all;
    for (std::string line; std::getline(lines, line);) all += worded_as_gcc(line + "\n");
    return all;
}

std::string missing_header(const std::string& line) {
    const std::string before = "fatal error: ", after = ": No such file or directory";
    const auto begin = line.find(before), end = line.find(after);
    if (begin == std::string::npos || end == std::string::npos || end < begin) return "";
    return line.substr(begin + before.size(), end - begin - before.size());
}

std::string missing_idl(const std::string& line) {
    static const std::regex missing("^[^:]+:[0-9]+: ([^:]+): No such file or directory$");
    std::smatch found;
    return std::regex_match(line, found, missing) ? found[1].str() : "";
}

std::vector<std::string> missing_headers(const std::string& output) {
    std::istringstream lines(output);
    std::vector<std::string> headers;
    for (std::string line; std::getline(lines, line);)
        if (const auto header = missing_header(line); !header.empty()) headers.push_back(header);
    return headers;
}

std::string between(const std::string& text, const std::string& before, const std::string& after) {
    const auto begin = text.find(before);
    if (begin == std::string::npos) return "";
    const auto end = text.find(after, begin + before.size());
    return end == std::string::npos ? "" : text.substr(begin + before.size(), end - begin - before.size());
}

std::string unknown_name(const std::string& line) {
    // g++ quotes names with these quotes in a UTF-8 locale, otherwise with apostrophes.
    for (const auto& [open, close] : {std::pair{"\u2018", "\u2019"}, std::pair{"'", "'"}}) {
        auto name = between(line, std::string("error: ") + open, close);
        if (!name.empty() && (line.find(" was not declared") != std::string::npos ||
                              line.find(" does not name a type") != std::string::npos ||
                              line.find(" has not been declared") != std::string::npos))
            return name;
    }
    return "";
}

std::string undefined_symbol(const std::string& line) {
    return between(line, "undefined reference to `", "'");
}

std::set<std::string> undefined_symbols(const std::string& output) {
    std::istringstream lines(output);
    std::set<std::string> symbols;
    for (std::string line; std::getline(lines, line);)
        if (auto symbol = undefined_symbol(line); !symbol.empty()) symbols.insert(std::move(symbol));
    return symbols;
}

} // namespace tandem::command
