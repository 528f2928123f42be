// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace tandem::text {

/// Returns the number that is the whole text, in the forms that strtod() takes, but with a decimal point whatever locale
/// a component has set. Empty if the text is no number.
std::optional<double> parse_number(const std::string& text);

} // namespace tandem::text
