// SPDX-License-Identifier: Apache-2.0
// What the three input archives share. Bytes may come from a file or from another process: a count in them is
// checked before anything is allocated for it.
#pragma once

#include <archive/opros_iarchive.h>

#include <cstddef>
#include <istream>
#include <string>

namespace opros::archive {

/// The bytes between the read position and the end of the stream, which must be seekable; 0 if it is not.
std::size_t remaining_bytes(std::istream& in);

/// Returns the count of elements or bytes that follow. Throws archive_array_size_exception when it is more than
/// the remaining bytes: each element takes at least one.
std::size_t check_count(std::istream& in, unsigned long count);

/// Makes `bytes` the next `count` bytes. Throws archive_array_size_exception, before it allocates, when fewer remain,
/// and archive_format_exception when they cannot be read.
void read_bytes(std::istream& in, unsigned long count, std::string& bytes);

/// Hands the bytes to the caller of iarchive::load_binary(): allocates *p with new[] when it is NULL, otherwise
/// throws archive_array_size_exception when `size` bytes there are too few. Sets size.
void copy_to_caller(const std::string& bytes, char** p, long& size);

/// The bytes as `length` characters in this machine's representation. Throws archive_format_exception when
/// their number does not fit.
std::wstring bytes_to_wstring(const std::string& bytes, unsigned long length);

/// A string as all formats have it: its length, then its characters as a block of bytes, which
/// `read_block(std::string&)` reads. Throws archive_format_exception when the two lengths differ.
template <typename ReadBlock>
void load_string(iarchive& ar, std::string& value, ReadBlock read_block) {
    unsigned long length = 0;
    ar.load(length);
    read_block(value);
    if (value.size() != length) throw archive_format_exception();
}

/// The same for wide characters: the length counts characters, the block counts bytes.
template <typename ReadBlock>
void load_wstring(iarchive& ar, std::wstring& value, ReadBlock read_block) {
    unsigned long length = 0;
    ar.load(length);
    std::string bytes;
    read_block(bytes);
    value = bytes_to_wstring(bytes, length);
}

} // namespace opros::archive
