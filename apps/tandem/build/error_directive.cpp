// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/error_directive.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <iterator>
#include <regex>
#include <sstream>

namespace tandem::command {
namespace {

// Returns the names that a preprocessor line tests with #ifdef, #ifndef or defined.
std::vector<std::string> names_asked_for(const std::string& line) {
    static const std::regex name("(?:ifn?def|defined)[ \t(]+([A-Za-z_][A-Za-z_0-9]*)");
    std::vector<std::string> names;
    for (std::sregex_iterator at(line.begin(), line.end(), name), end; at != end; ++at)
        names.push_back((*at)[1]);
    return names;
}

// Returns the macros in the conditions around line `last` that, if defined, skip this line. `lines` contain
// no comments.
std::vector<std::string> names_of_branches(const std::vector<std::string>& lines, std::size_t last) {
    static const std::regex directive("^[ \t]*#[ \t]*(ifndef|if|elif|else|endif)");
    std::vector<std::string> names;
    int inner = 0; // complete nested conditions
    bool other_branch = false;
    for (std::size_t i = last; i-- > 0;) {
        std::smatch found;
        if (!std::regex_search(lines[i], found, directive)) continue;
        const std::string word = found[1];
        if (word == "endif") ++inner;
        if (word == "endif" || (inner > 0 && (word == "elif" || word == "else"))) continue;
        if (inner > 0) {
            --inner; // the start of the nested condition
            continue;
        }
        // Defining the macros of #error's own condition does not skip #error, unless the condition is
        // #ifndef.
        const bool avoids = word == "ifndef" ? !other_branch : other_branch;
        const auto asked = names_asked_for(lines[i]);
        if (avoids) names.insert(names.begin(), asked.begin(), asked.end());
        if (word == "if" || word == "ifndef") break;
        other_branch = true;
    }
    return names;
}

} // namespace

std::vector<std::string> macros_that_avoid(const std::string& error) {
    static const std::regex place("^(.+):([0-9]{1,7}):[0-9]+: error: #error");
    std::smatch found;
    if (!std::regex_search(error, found, place)) return {};
    std::istringstream text(strip_comments(read_text(found[1].str())));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    const auto number = static_cast<std::size_t>(std::stoul(found[2]));
    if (number == 0 || number > lines.size()) return {};
    return names_of_branches(lines, number - 1);
}

} // namespace tandem::command
