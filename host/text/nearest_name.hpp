// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tandem::text {

/// The Levenshtein distance: the least number of letters inserted, deleted or replaced. Takes time with the product of
/// the lengths.
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The name with the least edit distance, upper and lower case being equal; empty if there are no names.
std::string nearest_name(const std::string& name, const std::vector<std::string>& names);

/// For the end of a message about an unknown name: "; did you mean speed_x?" if one of the names is so close that a
/// typing error is likely, otherwise empty.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& names);

} // namespace tandem::text
