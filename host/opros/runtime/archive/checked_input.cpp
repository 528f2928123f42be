// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/archive/checked_input.hpp"

#include <archive/opros_archive_common.h>

#include <cstring>

namespace opros::archive {

std::size_t remaining_bytes(std::istream& in) {
    const auto here = in.tellg();
    in.seekg(0, std::ios::end);
    const auto end = in.tellg();
    in.clear(); // seeking fails on a stream that cannot seek, and a failed stream cannot be read
    in.seekg(here);
    return here < 0 || end < here ? 0 : static_cast<std::size_t>(end - here);
}

std::size_t check_count(std::istream& in, unsigned long count) {
    if (count > remaining_bytes(in)) throw archive_array_size_exception();
    return count;
}

void read_bytes(std::istream& in, unsigned long count, std::string& bytes) {
    bytes.resize(check_count(in, count));
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (in.gcount() != static_cast<std::streamsize>(bytes.size())) throw archive_format_exception();
}

// Users' load() functions either pass their own memory or ask for an allocation, through the same function.
void copy_to_caller(const std::string& bytes, char** p, long& size) {
    if (*p == nullptr)
        *p = new char[bytes.size()];
    else if (static_cast<long>(bytes.size()) > size)
        throw archive_array_size_exception();
    std::memcpy(*p, bytes.data(), bytes.size());
    size = static_cast<long>(bytes.size());
}

std::wstring bytes_to_wstring(const std::string& bytes, unsigned long length) {
    // Divides because `length` times the size of a character could overflow.
    if (bytes.size() / sizeof(wchar_t) != length || bytes.size() % sizeof(wchar_t) != 0)
        throw archive_format_exception();
    std::wstring text(length, L'\0');
    std::memcpy(text.data(), bytes.data(), bytes.size());
    return text;
}

} // namespace opros::archive
