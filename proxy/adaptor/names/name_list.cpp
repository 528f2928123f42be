// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/names/name_list.hpp"

#include "host/text/split_names.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tandem::adaptor {

std::map<std::string, std::string> read_name_pairs(const std::string& property, const std::string& list,
                                                   const char* form) {
    std::map<std::string, std::string> pairs;
    for (const auto& entry : text::split_names(list)) {
        const auto equals = entry.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == entry.size())
            throw std::runtime_error(
                fmt::format("property '{}': '{}' is not valid: expected {}", property, entry, form));
        pairs[entry.substr(0, equals)] = entry.substr(equals + 1);
    }
    return pairs;
}

} // namespace tandem::adaptor
