// SPDX-License-Identifier: Apache-2.0
// Examples, numbers in hexadecimal:
//   double 1.5           'd' 08  00 00 00 00 00 00 f8 3f
//   class Point {x, y}   'T' 05 00 "Point"  x  y                  the members with their own codes
//   int[2] {1, 2}        'A' 08 02 00 00 00 00 00 00 00  'I' 04  01 00 00 00  02 00 00 00
//   "abc"                'T' 0b 00 "std::string"  'L' 08 <3>  'G' 08 <3> "abc"     <3>: 8 bytes
//   vector<int> {7}      'T' 10 00 "std::vector<int>"  'I' 04 01 00 00 00  'I' 04 07 00 00 00
#include "host/opros/runtime/archive/number_types.hpp"

#include <archive/opros_binary_oarchive.h>

#include <cstdint>

namespace opros::archive {

// The format (opros_binary_oarchive.h) is little endian. Numbers are copied from memory as they are.
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);

template <typename T>
void binary_oarchive::put_bytes(T value) {
    m_os->write(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Writes a number: its code, size and bytes, or only its bytes inside an array of numbers.
template <typename T>
oarchive& binary_oarchive::put(char code, T value) {
    if (!m_bare) {
        m_os->put(code);
        m_os->put(static_cast<char>(sizeof value));
    }
    put_bytes(value);
    return *this;
}

oarchive& binary_oarchive::save(bool value) { return put(BOOL_CODE, value ? '1' : '0'); }

#define OPROS_SAVE_NUMBER(type)                                                                              \
    oarchive& binary_oarchive::save(type value) { return put(type_code(&value), value); }
OPROS_SAVE_NUMBER(char)
OPROS_SAVE_NUMBER(signed char)
OPROS_SAVE_NUMBER(unsigned char)
OPROS_SAVE_NUMBER(wchar_t)
OPROS_FOR_EACH_NUMBER(OPROS_SAVE_NUMBER)
#undef OPROS_SAVE_NUMBER

oarchive& binary_oarchive::save_binary(const char* p, long size) {
    m_os->put(BINARY_CODE);
    m_os->put(static_cast<char>(sizeof size));
    put_bytes(size);
    m_os->write(p, size);
    return *this;
}

// The format treats a string as a class with two members: the length and the characters as a block of bytes.
oarchive& binary_oarchive::save(const std::string& value) {
    write_class_head("std::string");
    save(static_cast<unsigned long>(value.size()));
    return save_binary(value.data(), static_cast<long>(value.size()));
}

// Writes the characters as they are in memory, 4 bytes each on Linux. The length counts characters, not bytes.
oarchive& binary_oarchive::save(const std::wstring& value) {
    write_class_head("std::wstring");
    save(static_cast<unsigned long>(value.size()));
    return save_binary(reinterpret_cast<const char*>(value.data()),
                       static_cast<long>(value.size() * sizeof(wchar_t)));
}

oarchive& binary_oarchive::write_class_head(const std::string& name) {
    // The format has no head for the pairs of a map: keys and values alternate.
    return name.rfind("std::pair<", 0) == 0 ? *this : write_container_name(name);
}

oarchive& binary_oarchive::write_container_name(const std::string& name) {
    // The length field has 16 bits. A longer name, from deeply nested templates, is truncated.
    m_os->put(CLASS_CODE);
    put_bytes(static_cast<std::uint16_t>(name.size()));
    m_os->write(name.data(), static_cast<std::streamsize>(static_cast<std::uint16_t>(name.size())));
    return *this;
}

oarchive& binary_oarchive::write_sequence_head(std::size_t count) { return save(static_cast<int>(count)); }

oarchive& binary_oarchive::write_array_head(long size, char code, char bytes) {
    m_os->put(ARRAY_CODE);
    m_os->put(static_cast<char>(sizeof size));
    put_bytes(size);
    m_os->put(code);
    m_os->put(bytes);
    m_bare = code != CLASS_CODE;
    return *this;
}

oarchive& binary_oarchive::write_array_end(long, char, char) {
    m_bare = false;
    return *this;
}

} // namespace opros::archive
