// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::command {

/// Describes the automatic conversion between two connectable data ports with these signatures; "" if the bytes stay
/// the same. Throws wire::SignatureError.
std::string made_conversion(const std::string& sent, const std::string& received);

} // namespace tandem::command
