// SPDX-License-Identifier: Apache-2.0
// Examples:
//   double 1.5           d1.5;                          in mode 1: dX000000000000f83f;
//   class Point {x, y}   T[Point]d1;d2;;
//   int[2] {1, 2}        A[2]I1;I2;;
//   "abc"                T[std::string]L3;G[3]abc;;
//   vector<int> {7}      T[std::vector<int>]I1;I7;;     the count, then the elements
#include "host/opros/runtime/archive/number_types.hpp"
#include "host/opros/runtime/archive/pair_type.hpp"
#include "host/opros/runtime/archive/utf8.hpp"

#include <archive/opros_string_oarchive.h>

#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>

namespace opros::archive {
namespace {

/// Formats the value with enough digits to read the same value again. Ignores the locale.
template <typename T>
std::string in_decimal(T value) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::setprecision(std::numeric_limits<T>::max_digits10) << value;
    return text.str();
}

/// Formats the value as 'X' and two digits for each byte in the order of memory. Also exact for floating point.
template <typename T>
std::string in_hexadecimal(const T& value) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << 'X' << std::hex << std::setfill('0');
    for (std::size_t i = 0; i < sizeof value; ++i) text << std::setw(2) << static_cast<int>(bytes[i]);
    return text.str();
}

} // namespace

template <typename T>
oarchive& string_oarchive::put(char code, T value) {
    *m_os << code << (m_hexadecimal ? in_hexadecimal(value) : in_decimal(value)) << ';';
    return *this;
}

oarchive& string_oarchive::save(bool value) {
    *m_os << BOOL_CODE << (value ? 'T' : 'F') << ';';
    return *this;
}

#define OPROS_SAVE_CHARACTER(type)                                                                           \
    oarchive& string_oarchive::save(type value) {                                                            \
        if (m_hexadecimal) return put(CHAR_CODE, value);                                                     \
        *m_os << CHAR_CODE << static_cast<char>(value) << ';';                                               \
        return *this;                                                                                        \
    }
OPROS_SAVE_CHARACTER(char)
OPROS_SAVE_CHARACTER(signed char)
OPROS_SAVE_CHARACTER(unsigned char)
#undef OPROS_SAVE_CHARACTER

oarchive& string_oarchive::save(wchar_t value) {
    *m_os << WCHAR_T_CODE << to_utf8(value) << ';';
    return *this;
}

#define OPROS_SAVE_NUMBER(type)                                                                              \
    oarchive& string_oarchive::save(type value) { return put(type_code(&value), value); }
OPROS_FOR_EACH_NUMBER(OPROS_SAVE_NUMBER)
#undef OPROS_SAVE_NUMBER

oarchive& string_oarchive::save_binary(const char* p, long size) {
    *m_os << BINARY_CODE << '[' << in_decimal(size) << ']';
    m_os->write(p, size);
    *m_os << ';';
    return *this;
}

oarchive& string_oarchive::save(const std::string& value) {
    write_class_head("std::string");
    save(static_cast<unsigned long>(value.size()));
    save_binary(value.data(), static_cast<long>(value.size()));
    return write_class_end("std::string");
}

oarchive& string_oarchive::save(const std::wstring& value) {
    write_class_head("std::wstring");
    save(static_cast<unsigned long>(value.size()));
    save_binary(reinterpret_cast<const char*>(value.data()),
                static_cast<long>(value.size() * sizeof(wchar_t)));
    return write_class_end("std::wstring");
}

oarchive& string_oarchive::write_class_head(const std::string& name) {
    if (!is_pair_type(name)) *m_os << CLASS_CODE << '[' << name << ']';
    return *this;
}

oarchive& string_oarchive::write_class_end(const std::string& name) {
    if (!is_pair_type(name)) *m_os << ';';
    return *this;
}

oarchive& string_oarchive::write_container_name(const std::string& name) {
    m_named = true;
    return write_class_head(name);
}

// A named container has an additional ';' after its sequence; a bare sequence does not. m_inside stores, for each
// open sequence, whether it has a name.
oarchive& string_oarchive::write_sequence_head(std::size_t count) {
    m_inside.push_back(m_named);
    m_named = false;
    return save(static_cast<int>(count));
}

oarchive& string_oarchive::write_sequence_end() {
    if (m_inside.back()) *m_os << ';';
    m_inside.pop_back();
    return *this;
}

oarchive& string_oarchive::write_array_head(long size, char, char) {
    *m_os << ARRAY_CODE << '[' << in_decimal(size) << ']';
    return *this;
}

oarchive& string_oarchive::write_array_end(long, char, char) {
    *m_os << ';';
    return *this;
}

} // namespace opros::archive
