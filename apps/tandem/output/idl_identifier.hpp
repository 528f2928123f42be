// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::command {

/// Returns an IDL identifier for a word of letters, digits and _. Keywords get a leading underscore (OMG IDL 4.2,
/// section 7.2.3.2).
std::string idl_identifier(const std::string& word);

} // namespace tandem::command
