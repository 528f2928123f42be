// SPDX-License-Identifier: Apache-2.0
// The rule for names of links, which are parts of file names in /dev/shm and words of commands.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tandem::shm {

constexpr std::size_t max_link_name = 64; ///< characters
constexpr std::string_view link_name_characters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";

/// Returns whether links may have this name: 1 to 64 of the characters, the first not -, which begins an option.
constexpr bool is_link_name(std::string_view name) {
    return !name.empty() && name.size() <= max_link_name && !name.starts_with('-') &&
           name.find_first_not_of(link_name_characters) == std::string_view::npos;
}

/// Returns a name that links may have: the text's first 64 characters, with _ in place of those that may not be there.
inline std::string as_link_name(std::string_view text) {
    std::string name(text.substr(0, max_link_name));
    for (std::size_t at; (at = name.find_first_not_of(link_name_characters)) != std::string::npos;)
        name[at] = '_';
    if (name.empty() || name.front() == '-') name.replace(0, 1, "_");
    return name;
}

} // namespace tandem::shm
