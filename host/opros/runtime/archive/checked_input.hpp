// SPDX-License-Identifier: Apache-2.0
// What the three input archives share. Bytes may come from a file or from another process: a count in them is
// checked before anything is allocated for it.
#pragma once

#include <cstddef>
#include <istream>
#include <string>

namespace opros::archive {

/// The bytes between the read position and the end of the stream, which must be seekable; 0 if it is not.
std::size_t remaining_bytes(std::istream& in);

/// Returns the count of elements or bytes that follow. Throws archive_array_size_exception when it is more than
/// the remaining bytes: each element takes at least one.
std::size_t check_count(std::istream& in, unsigned long count);

/// Hands the bytes to the caller of iarchive::load_binary(): allocates *p with new[] when it is NULL, otherwise
/// throws archive_array_size_exception when `size` bytes there are too few. Sets size.
void copy_to_caller(const std::string& bytes, char** p, long& size);

/// The bytes as `length` characters in this machine's representation. Throws archive_format_exception when
/// their number does not fit.
std::wstring bytes_to_wstring(const std::string& bytes, unsigned long length);

} // namespace opros::archive
