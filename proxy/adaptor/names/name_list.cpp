// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/names/name_list.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tandem::adaptor {

std::vector<std::string> split_names(const std::string& text) {
    std::vector<std::string> names(1);
    for (const char c : text)
        if (c == ',')
            names.emplace_back();
        else if (c != ' ' && c != '\t' && c != '\n')
            names.back() += c;
    std::erase(names, "");
    return names;
}

std::map<std::string, std::string> read_name_pairs(const std::string& property, const std::string& text,
                                                   const char* form) {
    std::map<std::string, std::string> pairs;
    for (const auto& entry : split_names(text)) {
        const auto equals = entry.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == entry.size())
            throw std::runtime_error(
                fmt::format("property '{}': '{}' was found, {} was expected", property, entry, form));
        pairs[entry.substr(0, equals)] = entry.substr(equals + 1);
    }
    return pairs;
}

} // namespace tandem::adaptor
