// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace tandem::text {

/// Returns the number if it is the whole text, otherwise nothing. Accepts the forms of strtod(), with a decimal point
/// in any locale that a component sets.
std::optional<double> parse_number(const std::string& text);

} // namespace tandem::text
