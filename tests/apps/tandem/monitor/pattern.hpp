// SPDX-License-Identifier: Apache-2.0
// Regular expressions of POSIX: std::regex takes longer to compile than the tests that use one.
#pragma once
#include <regex.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace tandem::monitor::test {

/// An extended regular expression.
class Pattern {
  public:
    explicit Pattern(const char* text) {
        if (regcomp(&compiled_, text, REG_EXTENDED) != 0) throw std::invalid_argument(text);
    }
    ~Pattern() { regfree(&compiled_); }
    Pattern(const Pattern&) = delete;
    Pattern& operator=(const Pattern&) = delete;

    /// The first match from there and its groups; `from` is set past it. Nothing if there is none.
    std::vector<std::string> find(const std::string& text, std::size_t& from) const {
        std::vector<regmatch_t> found(compiled_.re_nsub + 1);
        found[0] = {static_cast<regoff_t>(from), static_cast<regoff_t>(text.size())};
        if (regexec(&compiled_, text.c_str(), found.size(), found.data(), REG_STARTEND) != 0) return {};
        std::vector<std::string> groups;
        for (const auto& [begin, end] : found)
            groups.push_back(begin < 0 ? ""
                                       : text.substr(static_cast<std::size_t>(begin),
                                                     static_cast<std::size_t>(end - begin)));
        from = static_cast<std::size_t>(found[0].rm_eo);
        return groups;
    }
    /// The groups if the whole text matches.
    std::vector<std::string> match(const std::string& text) const {
        std::size_t end = 0;
        auto groups = find(text, end);
        return groups.empty() || groups[0].size() != text.size() ? std::vector<std::string>() : groups;
    }

  private:
    regex_t compiled_;
};

} // namespace tandem::monitor::test
