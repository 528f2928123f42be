// SPDX-License-Identifier: Apache-2.0
#include "host/text/split_names.hpp"

#include <iterator>
#include <sstream>

namespace tandem::text {

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

std::vector<std::string> split_words(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

} // namespace tandem::text
