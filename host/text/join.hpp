// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace tandem::text {

/// Returns the texts of all items with a separator between them. `text_of`: a function or a member of an item, which
/// fmt::join does not take.
template <class Items, class TextOf = std::identity>
std::string join(const Items& items, std::string_view separator, TextOf text_of = {}) {
    std::string joined;
    bool is_first = true;
    for (const auto& item : items) {
        if (!std::exchange(is_first, false)) joined += separator;
        joined += std::invoke(text_of, item);
    }
    return joined;
}

} // namespace tandem::text
