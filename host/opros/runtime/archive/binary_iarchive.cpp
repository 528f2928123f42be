// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/archive/checked_input.hpp"
#include "host/opros/runtime/archive/number_types.hpp"

#include <archive/opros_binary_iarchive.h>

#include <cstdint>

namespace opros::archive {

// binary_oarchive.cpp describes the format. Each function throws archive_format_exception if the bytes end early, and
// archive_type_exception if they describe a type other than the requested one.

template <typename T>
T binary_iarchive::get_bytes() {
    T value;
    m_is->read(reinterpret_cast<char*>(&value), sizeof value);
    if (m_is->gcount() != static_cast<std::streamsize>(sizeof value)) throw archive_format_exception();
    return value;
}

void binary_iarchive::expect(char code) {
    if (get_bytes<char>() != code) throw archive_type_exception();
}

/// Reads a number: its code, size and bytes, or only its bytes inside an array of numbers.
template <typename T>
iarchive& binary_iarchive::get(char code, T& value) {
    if (!m_bare) {
        expect(code);
        if (get_bytes<char>() != static_cast<char>(sizeof value)) throw archive_type_exception();
    }
    value = get_bytes<T>();
    return *this;
}

iarchive& binary_iarchive::load(bool& value) {
    // The format stores a digit. Read it as a char first: a bool with any other value is undefined behavior.
    char digit = '0';
    get(BOOL_CODE, digit);
    value = digit != '0';
    return *this;
}

#define OPROS_LOAD_NUMBER(type)                                                                              \
    iarchive& binary_iarchive::load(type& value) { return get(type_code(&value), value); }
OPROS_LOAD_NUMBER(char)
OPROS_LOAD_NUMBER(signed char)
OPROS_LOAD_NUMBER(unsigned char)
OPROS_LOAD_NUMBER(wchar_t)
OPROS_FOR_EACH_NUMBER(OPROS_LOAD_NUMBER)
#undef OPROS_LOAD_NUMBER

/// Reads a block of bytes.
void binary_iarchive::get_blob(std::string& bytes) {
    expect(BINARY_CODE);
    expect(static_cast<char>(sizeof(long)));
    read_bytes(*m_is, get_bytes<unsigned long>(), bytes);
}

iarchive& binary_iarchive::load_binary(char** p, long& size) {
    std::string bytes;
    get_blob(bytes);
    copy_to_caller(bytes, p, size);
    return *this;
}

iarchive& binary_iarchive::load(std::string& value) {
    read_class_head("std::string");
    load_string(*this, value, [this](std::string& bytes) { get_blob(bytes); });
    return *this;
}

iarchive& binary_iarchive::load(std::wstring& value) {
    read_class_head("std::wstring");
    load_wstring(*this, value, [this](std::string& bytes) { get_blob(bytes); });
    return *this;
}

iarchive& binary_iarchive::read_class_head(const std::string& name) {
    // The format has no head for the pairs of a map: keys and values alternate.
    return name.rfind("std::pair<", 0) == 0 ? *this : read_container_name(name);
}

iarchive& binary_iarchive::read_container_name(const std::string& name) {
    expect(CLASS_CODE);
    std::string given(check_count(*m_is, get_bytes<std::uint16_t>()), '\0');
    m_is->read(given.data(), static_cast<std::streamsize>(given.size()));
    if (given != name) throw archive_type_exception();
    return *this;
}

std::size_t binary_iarchive::read_sequence_head() {
    int count = 0;
    load(count);
    return check_count(*m_is, static_cast<unsigned long>(count));
}

// The elements of an array of numbers have no code or size: the head gives both for all elements.
long binary_iarchive::read_array_head(long size, char code, char bytes) {
    expect(ARRAY_CODE);
    expect(static_cast<char>(sizeof size));
    if (get_bytes<long>() != size) throw archive_array_size_exception();
    expect(code);
    expect(bytes);
    m_bare = code != CLASS_CODE;
    return size;
}

iarchive& binary_iarchive::read_array_end(long, char, char) {
    m_bare = false;
    return *this;
}

} // namespace opros::archive
