// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Splits `A, B` into names without blanks.
std::vector<std::string> split_names(const std::string& text);

/// Parses `A=B, C=D` into a map. Throws std::runtime_error, one line, with the property's name and the expected form.
std::map<std::string, std::string> read_name_pairs(const std::string& property, const std::string& text,
                                                   const char* form);

} // namespace tandem::adaptor
