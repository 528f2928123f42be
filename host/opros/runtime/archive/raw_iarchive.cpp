// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/archive/checked_input.hpp"
#include "host/opros/runtime/archive/number_types.hpp"
#include "host/opros/runtime/archive/utf8.hpp"

#include <archive/opros_raw_iarchive.h>

#include <cstring>

namespace opros::archive {

// raw_oarchive.cpp describes the format. The format does not contain types, so a wrong type is not detected. Only
// bytes that end early and a count that exceeds the remaining bytes are errors.

template <typename T>
iarchive& raw_iarchive::get(T& value) {
    m_is->read(reinterpret_cast<char*>(&value), sizeof value);
    if (m_is->gcount() != static_cast<std::streamsize>(sizeof value)) throw archive_format_exception();
    return *this;
}

iarchive& raw_iarchive::load(bool& value) {
    // Read it as a char first: a bool with a value other than 0 or 1 is undefined behavior.
    char byte = 0;
    get(byte);
    value = byte != 0;
    return *this;
}
iarchive& raw_iarchive::load(char& value) { return get(value); }

iarchive& raw_iarchive::load(wchar_t& value) {
    // The number of bytes in UTF-8, then the bytes.
    char count = 0;
    get(count);
    if (count < 1 || count > 4) throw archive_format_exception();
    std::string bytes(static_cast<std::size_t>(count), '\0');
    for (char& byte : bytes) get(byte);
    value = from_utf8(bytes);
    return *this;
}

#define OPROS_LOAD_NUMBER(type)                                                                              \
    iarchive& raw_iarchive::load(type& value) { return get(value); }
OPROS_LOAD_NUMBER(signed char)
OPROS_LOAD_NUMBER(unsigned char)
OPROS_FOR_EACH_NUMBER(OPROS_LOAD_NUMBER)
#undef OPROS_LOAD_NUMBER

/// Reads a block of bytes.
void raw_iarchive::get_blob(std::string& bytes) {
    unsigned long count = 0;
    get(count);
    read_bytes(*m_is, count, bytes);
}

iarchive& raw_iarchive::load_binary(char** p, long& size) {
    std::string bytes;
    get_blob(bytes);
    copy_to_caller(bytes, p, size);
    return *this;
}

iarchive& raw_iarchive::load(std::string& value) {
    load_string(*this, value, [this](std::string& bytes) { get_blob(bytes); });
    return *this;
}

iarchive& raw_iarchive::load(std::wstring& value) {
    load_wstring(*this, value, [this](std::string& bytes) { get_blob(bytes); });
    return *this;
}

std::size_t raw_iarchive::read_sequence_head() {
    // A negative count becomes a large one, and the check refuses it.
    int count = 0;
    get(count);
    return check_count(*m_is, static_cast<unsigned long>(count));
}

} // namespace opros::archive
