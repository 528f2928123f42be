// SPDX-License-Identifier: Apache-2.0
// Examples, numbers in hexadecimal:
//   double 1.5           00 00 00 00 00 00 f8 3f
//   class Point {x, y}   x  y                          classes and arrays add no bytes
//   "abc"                <3> <3> "abc"                 <3>: 8 bytes
//   vector<int> {7}      01 00 00 00  07 00 00 00      the count, then the elements
#include "host/opros/runtime/archive/number_types.hpp"
#include "host/opros/runtime/archive/utf8.hpp"

#include <archive/opros_raw_oarchive.h>

namespace opros::archive {

// The format (opros_raw_oarchive.h) is little endian. Numbers are copied from memory as they are.
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);

template <typename T>
oarchive& raw_oarchive::put(T value) {
    m_os->write(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
}

oarchive& raw_oarchive::save(bool value) { return put(static_cast<char>(value)); }
oarchive& raw_oarchive::save(char value) { return put(value); }

// The format stores a wchar_t as its UTF-8 bytes after their number, unlike the characters of a std::wstring.
oarchive& raw_oarchive::save(wchar_t value) {
    const std::string bytes = to_utf8(value);
    put(static_cast<char>(bytes.size()));
    m_os->write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return *this;
}

#define OPROS_SAVE_NUMBER(type)                                                                              \
    oarchive& raw_oarchive::save(type value) { return put(value); }
OPROS_SAVE_NUMBER(signed char)
OPROS_SAVE_NUMBER(unsigned char)
OPROS_FOR_EACH_NUMBER(OPROS_SAVE_NUMBER)
#undef OPROS_SAVE_NUMBER

oarchive& raw_oarchive::save_binary(const char* p, long size) {
    put(size);
    m_os->write(p, size);
    return *this;
}

// The format stores the length twice: for the string, and for the block of its characters.
oarchive& raw_oarchive::save(const std::string& value) {
    put(static_cast<unsigned long>(value.size()));
    return save_binary(value.data(), static_cast<long>(value.size()));
}

oarchive& raw_oarchive::save(const std::wstring& value) {
    put(static_cast<unsigned long>(value.size()));
    return save_binary(reinterpret_cast<const char*>(value.data()),
                       static_cast<long>(value.size() * sizeof(wchar_t)));
}

oarchive& raw_oarchive::write_sequence_head(std::size_t count) { return put(static_cast<int>(count)); }

} // namespace opros::archive
