// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tandem::engine {

/// Converts the bytes of an XML file to UTF-8. The encoding is taken from the byte order mark, else from the
/// zero bytes around the first '<' (XML 1.0, appendix F), else from the XML declaration. Real profiles often
/// declare one encoding and are in another, so bytes that are valid UTF-8 stay as they are, and what is not
/// valid in any encoding becomes '?' (names of ports and types are ASCII). Never throws for the bytes.
std::string to_utf8(std::string_view bytes);

} // namespace tandem::engine
