// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace tandem::text {

/// Returns the texts of all items with a separator between them. `text_of`: a function or a member of an item.
template <class Items, class TextOf = std::identity>
std::string join(const Items& items, std::string_view separator, TextOf text_of = {}) {
    std::string joined;
    for (const auto& item : items) {
        if (!joined.empty()) joined += separator;
        joined += std::invoke(text_of, item);
    }
    return joined;
}

} // namespace tandem::text
