// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tandem::engine {

/// Converts the bytes of an XML file to UTF-8. The encoding is taken from the byte order mark, otherwise from the
/// zero bytes around the first '<' (XML 1.0, appendix F), otherwise from the XML declaration. The declaration of real
/// profiles is often wrong, so bytes that are valid UTF-8 stay unchanged. Bytes that are not valid in any encoding
/// become '?' (names of ports and types are ASCII). Never throws because of the bytes.
std::string to_utf8(std::string_view bytes);

} // namespace tandem::engine
