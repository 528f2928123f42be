// SPDX-License-Identifier: Apache-2.0
// Text from outside (names, files, another process) for a terminal or a log: it must not contain control sequences.
#pragma once

#include <string>
#include <string_view>

namespace tandem::text {

/// Returns the text with '?' for each control character, including newlines, and for each byte that is not UTF-8.
std::string printable_line(std::string_view text);

/// Like printable_line(), but keeps newlines and tabs.
std::string printable_text(std::string_view text);

} // namespace tandem::text
