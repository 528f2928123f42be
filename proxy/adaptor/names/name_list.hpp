// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// `A, B` as its names, without blanks.
std::vector<std::string> split_names(const std::string& text);

/// `A=B, C=D` as a map. Throws std::runtime_error, one line, with the property's name and the form that was expected.
std::map<std::string, std::string> read_name_pairs(const std::string& property, const std::string& text,
                                                   const char* form);

} // namespace tandem::adaptor
