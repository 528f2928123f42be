// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::command {

/// What happens to a value between two data ports that can be connected and for which no conversion is asked, in words; ""
/// if its bytes are the same. The arguments are signatures. Throws wire::SignatureError.
std::string made_conversion(const std::string& sent, const std::string& received);

} // namespace tandem::command
