// SPDX-License-Identifier: Apache-2.0
// The archive to which values are written. An implementation overrides only the virtual functions below and decides
// how it stores values. Everything else is based on these functions.
#ifndef OPROS_OARCHIVE_H
#define OPROS_OARCHIVE_H

#include <archive/opros_oarchive_fwd.h>
#include <archive/opros_serializable.h>

#include <cstddef>
#include <iostream>
#include <string>

/// Expands apply(TYPE) for each type that archives handle directly.
#define OPROS_FOR_EACH_PRIMITIVE(apply)                                                                      \
    apply(bool) apply(char) apply(signed char) apply(unsigned char) apply(wchar_t) apply(short)              \
        apply(unsigned short) apply(int) apply(unsigned int) apply(long) apply(unsigned long)                \
            apply(long long) apply(unsigned long long) apply(float) apply(double) apply(long double)

namespace opros {
namespace archive {

/// Not thread-safe. Exceptions of a user's save() pass through.
class oarchive : public archive {
  public:
    explicit oarchive(bool keepsNames = false) : archive(keepsNames) {}
    virtual ~oarchive() {}

#define OPROS_SAVE_PRIMITIVE(type) virtual oarchive& save(type value) = 0;
    OPROS_FOR_EACH_PRIMITIVE(OPROS_SAVE_PRIMITIVE)
#undef OPROS_SAVE_PRIMITIVE
    virtual oarchive& save(const std::string& value) = 0;
    virtual oarchive& save(const std::wstring& value) = 0;
    /// Writes bytes whose meaning only the user knows.
    virtual oarchive& save_binary(const char* p, long size) = 0;

    /// Writes elements of a sequence or array whose head has been written; one by one unless overridden.
#define OPROS_SAVE_ELEMENTS(type) virtual oarchive& save_array(const type* p, long size);
    OPROS_FOR_EACH_PRIMITIVE(OPROS_SAVE_ELEMENTS)
#undef OPROS_SAVE_ELEMENTS
    /// Writes a sequence of numbers: head, elements and end. Uses those functions unless overridden (ours).
#define OPROS_SAVE_SEQUENCE(type) virtual oarchive& save_sequence(const type* p, std::size_t count);
    OPROS_FOR_EACH_PRIMITIVE(OPROS_SAVE_SEQUENCE)
#undef OPROS_SAVE_SEQUENCE

    /// Begin and end a class. Standard containers are not classes. The name is empty if the archive does not keep
    /// names.
    virtual oarchive& write_class_head(const std::string&) { return *this; }
    virtual oarchive& write_class_end(const std::string&) { return *this; }
    /// Names the container of the next sequence. Only for archives that keep names.
    virtual oarchive& write_container_name(const std::string&) { return *this; }
    /// Begins a sequence of `count` elements of one type. The count may differ next time.
    virtual oarchive& write_sequence_head(std::size_t count) = 0;
    virtual oarchive& write_sequence_end() { return *this; }
    /// Begins an array of elements of one type. The number of elements is part of the type.
    virtual oarchive& write_array_head(long, char /*code*/, char /*bytes of one*/) { return *this; }
    virtual oarchive& write_array_end(long, char, char) { return *this; }
    /// Names the next member.
    virtual oarchive& write_start_tag(const std::string&) { return *this; }
    virtual oarchive& write_end_tag(const std::string&) { return *this; }

    /// Writes a value of any type that can be archived (opros_serializable.h). Others do not compile.
    template <typename T>
    oarchive& save(const T& value);
    template <typename T>
    oarchive& save(const opros::nvp<T>& pair);
    template <typename T, std::size_t N>
    oarchive& save(const T (&values)[N]);
    /// Writes a sequence of `size` elements.
    template <typename T>
    oarchive& save(const T* p, long size);
    oarchive& save(const char* p, long size) { return save_binary(p, size); }
    oarchive& save(const unsigned char* p, long size) {
        return save_binary(reinterpret_cast<const char*>(p), size);
    }
    oarchive& save(const signed char* p, long size) {
        return save_binary(reinterpret_cast<const char*>(p), size);
    }
};

// Write the types of each kind. The last argument selects the overload.
namespace detail {

// Numbers at once, so that an archive may copy them as one block. Others one by one.
template <typename T>
oarchive& save_elements(oarchive& ar, const T* p, long size, by_primitive) {
    return ar.save_array(p, size);
}
template <typename T, typename Way>
oarchive& save_elements(oarchive& ar, const T* p, long size, Way) {
    for (long i = 0; i < size; ++i) ar.save(p[i]);
    return ar;
}

// An enumeration crosses as an int, independent of its underlying type.
template <typename T>
void save_value(oarchive& ar, const T& value, by_enumeration) {
    ar.save(static_cast<int>(value));
}
template <typename T, typename Way>
void save_value(oarchive& ar, const T& value, Way how) {
    if (is_container<T>::value) {
        if (ar.keeps_names()) ar.write_container_name(getTypeName<T>());
        serialize_class(ar, const_cast<T&>(value), how);
        return;
    }
    const std::string name = ar.keeps_names() ? getTypeName<T>() : std::string();
    ar.write_class_head(name);
    serialize_class(ar, const_cast<T&>(value), how); // users' save() is not const
    ar.write_class_end(name);
}

} // namespace detail

template <typename T>
oarchive& oarchive::save(const T& value) {
    detail::save_value(*this, value, typename detail::way<T>::type());
    return *this;
}

template <typename T>
oarchive& oarchive::save(const opros::nvp<T>& pair) {
    if (!keeps_names()) return save(pair.getData());
    write_start_tag(pair.getName());
    save(pair.getData());
    return write_end_tag(pair.getName());
}

template <typename T, std::size_t N>
oarchive& oarchive::save(const T (&values)[N]) {
    const char code = type_code(static_cast<T*>(0));
    write_array_head(N, code, sizeof(T));
    detail::save_elements(*this, values, N, typename detail::way<T>::type());
    return write_array_end(N, code, sizeof(T));
}

template <typename T>
oarchive& oarchive::save(const T* p, long size) {
    write_sequence_head(static_cast<std::size_t>(size));
    detail::save_elements(*this, p, size, typename detail::way<T>::type());
    return write_sequence_end();
}

template <typename T>
oarchive& operator<<(oarchive& ar, const T& value) {
    return ar.save(value);
}
// Boost's own pairs, for sources that include Boost.Serialization.
template <typename T>
oarchive& operator<<(oarchive& ar, const boost::serialization::nvp<T>& pair) {
    return ar.save(makenvp(pair.name(), pair.value()));
}
template <typename T>
oarchive& operator&(oarchive& ar, const boost::serialization::nvp<T>& pair) {
    return ar << pair;
}
template <typename T>
oarchive& operator&(oarchive& ar, const T& value) {
    return ar.save(value);
}

} // namespace archive
} // namespace opros

#endif
