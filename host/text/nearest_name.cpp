// SPDX-License-Identifier: Apache-2.0
#include "host/text/nearest_name.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace tandem::text {
namespace {

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::size_t distance_without_case(const std::string& a, const std::string& b) {
    return edit_distance(lower_case(a), lower_case(b));
}

} // namespace

// Keeps one row of the matrix. `diagonal` is the entry above and to the left of the current one.
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
        }
    }
    return row.back();
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& names) {
    const auto nearest = std::min_element(names.begin(), names.end(), [&](const auto& a, const auto& b) {
        return distance_without_case(name, a) < distance_without_case(name, b);
    });
    return nearest == names.end() ? "" : *nearest;
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& names) {
    constexpr std::size_t max_compared = 100; // a longer name is not a typing error
    if (name.size() > max_compared) return "";
    const std::string nearest = nearest_name(name, names);
    // One letter in three, at least two: GriiperAPI for GripperAPI, sped for speed.
    const std::size_t likely = std::max<std::size_t>(2, name.size() / 3);
    // Short names are all similar.
    if (nearest.size() < 3 || name.size() < 3 || distance_without_case(name, nearest) > likely) return "";
    return "; did you mean " + nearest + "?";
}

} // namespace tandem::text
