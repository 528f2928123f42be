// SPDX-License-Identifier: Apache-2.0
#include <archive/opros_binary_oarchive.h>

#include <cstdint>

namespace opros::archive {

// Little endian, as is every machine this is built for; the format has no other order.
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);

template <typename T>
void binary_oarchive::put_bytes(T value) {
    m_os->write(reinterpret_cast<const char*>(&value), sizeof value);
}

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
OPROS_SAVE_NUMBER(short)
OPROS_SAVE_NUMBER(unsigned short)
OPROS_SAVE_NUMBER(int)
OPROS_SAVE_NUMBER(unsigned int)
OPROS_SAVE_NUMBER(long)
OPROS_SAVE_NUMBER(unsigned long)
OPROS_SAVE_NUMBER(long long)
OPROS_SAVE_NUMBER(unsigned long long)
OPROS_SAVE_NUMBER(float)
OPROS_SAVE_NUMBER(double)
OPROS_SAVE_NUMBER(long double)
#undef OPROS_SAVE_NUMBER

oarchive& binary_oarchive::save_binary(const char* p, long size) {
    m_os->put(BINARY_CODE);
    m_os->put(static_cast<char>(sizeof size));
    put_bytes(size);
    m_os->write(p, size);
    return *this;
}

oarchive& binary_oarchive::save(const std::string& value) {
    write_class_head("std::string");
    save(static_cast<unsigned long>(value.size()));
    return save_binary(value.data(), static_cast<long>(value.size()));
}

oarchive& binary_oarchive::save(const std::wstring& value) {
    write_class_head("std::wstring");
    save(static_cast<unsigned long>(value.size()));
    return save_binary(reinterpret_cast<const char*>(value.data()),
                       static_cast<long>(value.size() * sizeof(wchar_t)));
}

oarchive& binary_oarchive::write_class_head(const std::string& name) {
    // The entries of a map are its keys and values, one after the other.
    return name.rfind("std::pair<", 0) == 0 ? *this : write_container_name(name);
}

oarchive& binary_oarchive::write_container_name(const std::string& name) {
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
