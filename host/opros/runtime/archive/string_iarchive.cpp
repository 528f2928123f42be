// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/archive/checked_input.hpp"
#include "host/opros/runtime/archive/number_types.hpp"
#include "host/opros/runtime/archive/pair_type.hpp"
#include "host/opros/runtime/archive/utf8.hpp"

#include <archive/opros_string_iarchive.h>

#include <charconv>
#include <cstring>
#include <sstream>

namespace opros::archive {
namespace {

/// Maximum length of a number or of the name of a type. It ends a search for a missing ';'.
constexpr std::size_t max_token_length = 4096;

/// Parses a number, which must be the whole text. Ignores the locale, because a component may have set it.
template <typename T>
T from_decimal(const std::string& text) {
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    T value{};
    in >> value;
    if (!in || in.peek() != std::char_traits<char>::eof()) throw archive_format_exception();
    return value;
}

/// Parses 'X' and two digits for each byte, in the little-endian order of memory. Upstream's archive appends the
/// decimal value, which this function skips.
template <typename T>
T from_hexadecimal(const std::string& text) {
    if (text.size() < 1 + 2 * sizeof(T)) throw archive_format_exception();
    unsigned char bytes[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        const char* digits = text.data() + 1 + 2 * i;
        const auto read = std::from_chars(digits, digits + 2, bytes[i], 16);
        if (read.ec != std::errc() || read.ptr != digits + 2) throw archive_format_exception();
    }
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

} // namespace

void string_iarchive::expect(char code) {
    char given = 0;
    if (!m_is->get(given)) throw archive_format_exception();
    if (given != code) throw archive_type_exception();
}

/// Returns the characters before `end` and consumes `end`.
std::string string_iarchive::up_to(char end) {
    std::string text;
    for (char c = 0; text.size() <= max_token_length && m_is->get(c);) {
        if (c == end) return text;
        text += c;
    }
    throw archive_format_exception();
}

template <typename T>
iarchive& string_iarchive::get(char code, T& value) {
    expect(code);
    const std::string text = up_to(';');
    value = text[0] == 'X' ? from_hexadecimal<T>(text) : from_decimal<T>(text);
    return *this;
}

iarchive& string_iarchive::load(bool& value) {
    expect(BOOL_CODE);
    const std::string text = up_to(';');
    if (text != "T" && text != "F") throw archive_format_exception();
    value = text == "T";
    return *this;
}

// Any character is written as itself. Only the character after an 'X' shows whether the 'X' is the value or starts a
// hexadecimal form.
#define OPROS_LOAD_CHARACTER(type)                                                                           \
    iarchive& string_iarchive::load(type& value) {                                                           \
        expect(CHAR_CODE);                                                                                   \
        char given = 0, next = 0;                                                                            \
        if (!m_is->get(given) || !m_is->get(next)) throw archive_format_exception();                         \
        if (next != ';') given = from_hexadecimal<char>(std::string(1, given) + next + up_to(';'));          \
        value = static_cast<type>(given);                                                                    \
        return *this;                                                                                        \
    }
OPROS_LOAD_CHARACTER(char)
OPROS_LOAD_CHARACTER(signed char)
OPROS_LOAD_CHARACTER(unsigned char)
#undef OPROS_LOAD_CHARACTER

iarchive& string_iarchive::load(wchar_t& value) {
    expect(WCHAR_T_CODE);
    std::string bytes = up_to(';');
    // No byte before the ';': this ';' is the character, and a second one ends it.
    if (bytes.empty()) {
        expect(';');
        value = L';';
    } else {
        value = from_utf8(bytes);
    }
    return *this;
}

#define OPROS_LOAD_NUMBER(type)                                                                              \
    iarchive& string_iarchive::load(type& value) { return get(type_code(&value), value); }
OPROS_FOR_EACH_NUMBER(OPROS_LOAD_NUMBER)
#undef OPROS_LOAD_NUMBER

void string_iarchive::get_blob(std::string& bytes) {
    expect(BINARY_CODE);
    expect('[');
    read_bytes(*m_is, from_decimal<unsigned long>(up_to(']')), bytes);
    expect(';');
}

iarchive& string_iarchive::load_binary(char** p, long& size) {
    std::string bytes;
    get_blob(bytes);
    copy_to_caller(bytes, p, size);
    return *this;
}

iarchive& string_iarchive::load(std::string& value) {
    read_class_head("std::string");
    load_string(*this, value, [this](std::string& bytes) { get_blob(bytes); });
    return read_class_end("std::string");
}

iarchive& string_iarchive::load(std::wstring& value) {
    read_class_head("std::wstring");
    load_wstring(*this, value, [this](std::string& bytes) { get_blob(bytes); });
    return read_class_end("std::wstring");
}

iarchive& string_iarchive::read_class_head(const std::string& name) {
    if (is_pair_type(name)) return *this;
    expect(CLASS_CODE);
    expect('[');
    // The name ends at the first ']', because names of types that can be archived contain none.
    if (up_to(']') != name) throw archive_type_exception();
    return *this;
}

iarchive& string_iarchive::read_class_end(const std::string& name) {
    if (!is_pair_type(name)) expect(';');
    return *this;
}

iarchive& string_iarchive::read_container_name(const std::string& name) {
    m_named = true;
    return read_class_head(name);
}

// A named container has an additional ';' after its sequence; a bare sequence does not. m_inside stores, for each
// open sequence, whether it has a name.
std::size_t string_iarchive::read_sequence_head() {
    m_inside.push_back(m_named);
    m_named = false;
    int count = 0;
    load(count);
    return check_count(*m_is, static_cast<unsigned long>(count));
}

iarchive& string_iarchive::read_sequence_end() {
    if (m_inside.back()) expect(';');
    m_inside.pop_back();
    return *this;
}

long string_iarchive::read_array_head(long size, char, char) {
    expect(ARRAY_CODE);
    expect('[');
    if (from_decimal<long>(up_to(']')) != size) throw archive_array_size_exception();
    return size;
}

iarchive& string_iarchive::read_array_end(long, char, char) {
    expect(';');
    return *this;
}

} // namespace opros::archive
