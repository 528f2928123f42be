// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <istream>
#include <string>

namespace opros::archive {

/// What is left to read. Malformed counts must not make an archive allocate what the bytes cannot hold: each
/// element takes at least one byte.
std::size_t remaining_bytes(std::istream& in);
/// The count; throws archive_array_size_exception when it is more than is left.
std::size_t check_count(std::istream& in, unsigned long count);
/// Hands a block of bytes over as iarchive::load_binary() says.
void copy_to_caller(const std::string& bytes, char** p, long& size);
/// The bytes as so many wide characters; throws archive_format_exception when they are not that many.
std::wstring bytes_to_wstring(const std::string& bytes, unsigned long length);

} // namespace opros::archive
