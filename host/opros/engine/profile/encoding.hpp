// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tandem::engine {

/// The text of an XML file as UTF-8: by its byte order mark, by how its first bytes lie, or by the encoding
/// that it declares. Real profiles declare one and are in another: what is UTF-8 already stays as it is, and
/// what does not fit becomes '?', since the names that matter are ASCII.
std::string to_utf8(std::string_view bytes);

} // namespace tandem::engine
