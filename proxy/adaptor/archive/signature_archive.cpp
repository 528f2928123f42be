// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/archive/signature_archive.hpp"

#include <type_traits>

namespace tandem::adaptor {

using opros::archive::iarchive;

namespace {

/// The type code of an OPRoS primitive; 0 for one that cannot cross the link. `long` has the code of its size,
/// so that the same source means the same on both hosts, which run on one machine.
template <class T>
constexpr char code() {
    if constexpr (std::is_same_v<T, bool>)
        return 'b';
    else if constexpr (std::is_same_v<T, unsigned char>)
        return 'y';
    else if constexpr (std::is_same_v<T, wchar_t> || std::is_same_v<T, long double>)
        return 0;
    else if constexpr (std::is_floating_point_v<T>)
        return sizeof(T) == 4 ? 'f' : 'd';
    else if constexpr (sizeof(T) == 1)
        return 'c';
    else if constexpr (sizeof(T) == 2)
        return std::is_signed_v<T> ? 'n' : 'q';
    else if constexpr (sizeof(T) == 4)
        return std::is_signed_v<T> ? 'i' : 'u';
    else
        return std::is_signed_v<T> ? 'x' : 't';
}

} // namespace

#define TANDEM_LOAD(type)                                                                                    \
    iarchive& SignatureArchive::load(type& value) {                                                          \
        if (code<type>() == 0) throw opros::archive::archive_type_exception();                               \
        value = {};                                                                                          \
        signature_ += code<type>();                                                                          \
        return *this;                                                                                        \
    }
OPROS_FOR_EACH_PRIMITIVE(TANDEM_LOAD)
#undef TANDEM_LOAD

iarchive& SignatureArchive::load(std::string&) {
    signature_ += 's';
    return *this;
}

// Wide characters have no encoding of their own in CDR: it depends on the CORBA connection.
iarchive& SignatureArchive::load(std::wstring&) { throw opros::archive::archive_type_exception(); }

iarchive& SignatureArchive::load_binary(char** p, long& size) {
    signature_ += "ay";
    if (*p == nullptr) *p = new char[1](); // by the archive's contract the caller deletes it
    size = 0;
    return *this;
}

std::size_t SignatureArchive::read_sequence_head() {
    signature_ += 'a';
    return 1; // one element, so that the type loads it and shows its signature
}

iarchive& SignatureArchive::read_class_head(const std::string&) {
    signature_ += '(';
    return *this;
}

iarchive& SignatureArchive::read_class_end(const std::string&) {
    signature_ += ')';
    return *this;
}

long SignatureArchive::read_array_head(long size, char, char) {
    signature_ += '[' + std::to_string(size) + ']';
    return 1;
}

} // namespace tandem::adaptor
