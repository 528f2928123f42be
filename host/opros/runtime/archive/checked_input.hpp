// SPDX-License-Identifier: Apache-2.0
// Functions that the three input archives share. The bytes may come from a file or from another process, so a count
// in them is checked before memory is allocated for it.
#pragma once

#include <archive/opros_iarchive.h>

#include <cstddef>
#include <istream>
#include <string>

namespace opros::archive {

/// Returns the number of bytes between the read position and the end of the stream. Returns 0 if the stream cannot
/// seek.
std::size_t remaining_bytes(std::istream& in);

/// Returns `count`, the number of elements or bytes that follow. Throws archive_array_size_exception if fewer bytes
/// remain: each element takes at least one byte.
std::size_t check_count(std::istream& in, unsigned long count);

/// Reads the next `count` bytes into `bytes`. Throws archive_array_size_exception, before it allocates, if fewer
/// bytes remain, and archive_format_exception if the stream cannot read them.
void read_bytes(std::istream& in, unsigned long count, std::string& bytes);

/// Copies the bytes to the caller of iarchive::load_binary() and sets `size` to their number. If *p is NULL,
/// allocates *p with new[]. Otherwise *p points to `size` bytes; throws archive_array_size_exception if they are too
/// few.
void copy_to_caller(const std::string& bytes, char** p, long& size);

/// Converts the bytes, in this machine's representation, to `length` characters. Throws archive_format_exception if
/// the number of bytes does not match.
std::wstring bytes_to_wstring(const std::string& bytes, unsigned long length);

/// Reads a string. In all formats a string is its length and then its characters as a block of bytes, which
/// `read_block(std::string&)` reads. Throws archive_format_exception if the two lengths differ.
template <typename ReadBlock>
void load_string(iarchive& ar, std::string& value, ReadBlock read_block) {
    unsigned long length = 0;
    ar.load(length);
    read_block(value);
    if (value.size() != length) throw archive_format_exception();
}

/// Reads a wide string. The length counts characters, the block counts bytes.
template <typename ReadBlock>
void load_wstring(iarchive& ar, std::wstring& value, ReadBlock read_block) {
    unsigned long length = 0;
    ar.load(length);
    std::string bytes;
    read_block(bytes);
    value = bytes_to_wstring(bytes, length);
}

} // namespace opros::archive
