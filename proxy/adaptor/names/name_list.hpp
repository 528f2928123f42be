// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

namespace tandem::adaptor {

/// Parses `A=B, C=D` into a map. Throws std::runtime_error, one line, with the property's name and the expected form.
std::map<std::string, std::string> read_name_pairs(const std::string& property, const std::string& list,
                                                   const char* form);

} // namespace tandem::adaptor
