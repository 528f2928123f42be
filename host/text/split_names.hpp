// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tandem::text {

/// Splits `A, B` into names without blanks. Omits empty names.
std::vector<std::string> split_names(const std::string& text);
/// Splits `A B` at white space. Omits empty words.
std::vector<std::string> split_words(const std::string& text);

} // namespace tandem::text
