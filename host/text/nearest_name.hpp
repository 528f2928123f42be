// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tandem::text {

/// Returns the Levenshtein distance: the least number of letters to insert, delete or replace. The time is
/// proportional to the product of the lengths.
std::size_t edit_distance(const std::string& a, const std::string& b);

/// Returns the name with the least edit distance, ignoring case, or an empty string if there are no names.
std::string nearest_name(const std::string& name, const std::vector<std::string>& names);

/// Returns the end of a message about an unknown name: "; did you mean speed_x?" if a name is so similar that a
/// typing error is likely, otherwise an empty string.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& names);

} // namespace tandem::text
