// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/first_error.hpp"

#include <sstream>

namespace tandem::command {
namespace {

// Returns an error of CMake in one line. CMake prints the place, then the indented and wrapped text, then an
// empty line.
std::string cmake_error(std::string text, std::istream& lines) {
    for (std::string line; std::getline(lines, line) && line.rfind("  ", 0) == 0;)
        text += line.substr(1); // keeps one of the two spaces as separator
    return text;
}

} // namespace

// Later errors of a compiler are mostly consequences of the first one.
std::string first_error(const std::string& output) {
    std::istringstream lines(output);
    std::string line, last;
    while (std::getline(lines, line)) {
        if (line.find("CMake Error at ") != std::string::npos) return cmake_error(line, lines);
        for (const char* word :
             {"error: ", "undefined reference", "multiple definition", "CMake Error", "undefined symbol",
              // from omniidl
              ": Syntax error", ": Error in ", ": No such file or directory"})
            if (line.find(word) != std::string::npos) return line;
        if (line.find_first_not_of(" \t") != std::string::npos) last = line;
    }
    return last;
}

std::string missing_header(const std::string& line) {
    const std::string before = "fatal error: ", after = ": No such file or directory";
    const auto begin = line.find(before), end = line.find(after);
    if (begin == std::string::npos || end == std::string::npos || end < begin) return "";
    return line.substr(begin + before.size(), end - begin - before.size());
}

std::vector<std::string> missing_headers(const std::string& output) {
    std::istringstream lines(output);
    std::vector<std::string> headers;
    for (std::string line; std::getline(lines, line);)
        if (const auto header = missing_header(line); !header.empty()) headers.push_back(header);
    return headers;
}

} // namespace tandem::command
