// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/archive/checked_input.hpp"
#include "host/opros/runtime/archive/number_types.hpp"
#include "host/opros/runtime/archive/utf8.hpp"

#include <archive/opros_raw_iarchive.h>

#include <cstring>

namespace opros::archive {

// The format is that of raw_oarchive.cpp. Nothing in it says what a value is: a wrong type is not noticed, only bytes
// that end early or a count that is more than what is left.

template <typename T>
iarchive& raw_iarchive::get(T& value) {
    m_is->read(reinterpret_cast<char*>(&value), sizeof value);
    if (m_is->gcount() != static_cast<std::streamsize>(sizeof value)) throw archive_format_exception();
    return *this;
}

iarchive& raw_iarchive::load(bool& value) {
    // Read as any byte first, since a bool with another value than 0 or 1 is undefined.
    char byte = 0;
    get(byte);
    value = byte != 0;
    return *this;
}
iarchive& raw_iarchive::load(char& value) { return get(value); }

iarchive& raw_iarchive::load(wchar_t& value) {
    // The number of bytes in UTF-8, then these.
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

/// A block of bytes.
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
    // A negative count becomes a large one, which the check refuses.
    int count = 0;
    get(count);
    return check_count(*m_is, static_cast<unsigned long>(count));
}

} // namespace opros::archive
