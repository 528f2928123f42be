// SPDX-License-Identifier: Apache-2.0
// The archive from which values are read; the counterpart of opros_oarchive.h. Throws one of the archive exceptions
// for malformed input.
#ifndef OPROS_IARCHIVE_H
#define OPROS_IARCHIVE_H

#include <archive/opros_iarchive_fwd.h>
#include <archive/opros_oarchive.h>

#include <vector>

namespace opros {
namespace archive {

/// Not thread-safe. Reads one value after the other. After an exception, the position in the bytes is unknown.
class iarchive : public archive {
  public:
    explicit iarchive(bool keepsNames = false) : archive(keepsNames) {}
    virtual ~iarchive() {}

#define OPROS_LOAD_PRIMITIVE(type) virtual iarchive& load(type& value) = 0;
    OPROS_FOR_EACH_PRIMITIVE(OPROS_LOAD_PRIMITIVE)
#undef OPROS_LOAD_PRIMITIVE
    virtual iarchive& load(std::string& value) = 0;
    virtual iarchive& load(std::wstring& value) = 0;
    /// Reads bytes and sets `size` to their number. If *p is NULL, allocates *p with new char[]. Otherwise `size` is
    /// the space at *p; throws archive_array_size_exception if it is too small.
    virtual iarchive& load_binary(char** p, long& size) = 0;

#define OPROS_LOAD_ELEMENTS(type) virtual iarchive& load_array(type* p, long size);
    OPROS_FOR_EACH_PRIMITIVE(OPROS_LOAD_ELEMENTS)
#undef OPROS_LOAD_ELEMENTS
    /// Reads a sequence of numbers in place: head, elements and end. Uses those functions unless overridden (ours).
#define OPROS_LOAD_SEQUENCE(type) virtual iarchive& load_sequence(std::vector<type>& values);
    OPROS_FOR_EACH_PRIMITIVE(OPROS_LOAD_SEQUENCE)
#undef OPROS_LOAD_SEQUENCE

    // Read the structure of the next value as the functions of oarchive have written it. Archives without names or
    // marks do not override them.
    virtual iarchive& read_class_head(const std::string&) { return *this; }
    virtual iarchive& read_class_end(const std::string&) { return *this; }
    virtual iarchive& read_container_name(const std::string&) { return *this; }
    /// Returns the number of elements that the caller must load, checked against the remaining bytes.
    virtual std::size_t read_sequence_head() = 0;
    virtual iarchive& read_sequence_end() { return *this; }
    /// Returns the number of array elements that the caller must load: all, unless the archive only records types.
    virtual long read_array_head(long size, char /*code*/, char /*bytes of one*/) { return size; }
    virtual iarchive& read_array_end(long, char, char) { return *this; }
    virtual iarchive& read_start_tag(const std::string&) { return *this; }
    virtual iarchive& read_end_tag(const std::string&) { return *this; }

    /// Reads a value, in place, of any type that can be archived (opros_serializable.h). Others do not compile.
    template <typename T>
    iarchive& load(T& value);
    template <typename T>
    iarchive& load(const opros::nvp<T>& pair);
    template <typename T, std::size_t N>
    iarchive& load(T (&values)[N]);
    /// Reads a sequence of T like load_binary(), with elements instead of bytes.
    template <typename T>
    iarchive& load(T** p, long& size);
    template <typename T>
    iarchive& load(T** p, const long& size) {
        long given = size;
        return load(p, given);
    }
    iarchive& load(char** p, long& size) { return load_binary(p, size); }
    iarchive& load(unsigned char** p, long& size) { return load_binary(reinterpret_cast<char**>(p), size); }
    iarchive& load(signed char** p, long& size) { return load_binary(reinterpret_cast<char**>(p), size); }
};

// Read the types of each kind. The last argument selects the overload.
namespace detail {

// Numbers at once, so that an archive may copy them as one block. Others one by one.
template <typename T>
iarchive& load_elements(iarchive& ar, T* p, long size, by_primitive) {
    return ar.load_array(p, size);
}
template <typename T, typename Way>
iarchive& load_elements(iarchive& ar, T* p, long size, Way) {
    for (long i = 0; i < size; ++i) ar.load(p[i]);
    return ar;
}

// An enumeration crosses as an int. Any number may come from outside, so the user's code must expect it.
template <typename T>
void load_value(iarchive& ar, T& value, by_enumeration) {
    int number = 0;
    ar.load(number);
    value = static_cast<T>(number);
}
template <typename T, typename Way>
void load_value(iarchive& ar, T& value, Way how) {
    if (is_container<T>::value) {
        if (ar.keeps_names()) ar.read_container_name(getTypeName<T>());
        serialize_class(ar, value, how);
        return;
    }
    const std::string name = ar.keeps_names() ? getTypeName<T>() : std::string();
    ar.read_class_head(name);
    serialize_class(ar, value, how);
    ar.read_class_end(name);
}

} // namespace detail

template <typename T>
iarchive& iarchive::load(T& value) {
    detail::load_value(*this, value, typename detail::way<T>::type());
    return *this;
}

template <typename T>
iarchive& iarchive::load(const opros::nvp<T>& pair) {
    if (!keeps_names()) return load(pair.getData());
    read_start_tag(pair.getName());
    load(pair.getData());
    return read_end_tag(pair.getName());
}

template <typename T, std::size_t N>
iarchive& iarchive::load(T (&values)[N]) {
    const char code = type_code(static_cast<T*>(0));
    const long wanted = read_array_head(N, code, sizeof(T));
    detail::load_elements(*this, values, wanted, typename detail::way<T>::type());
    return read_array_end(N, code, sizeof(T));
}

// The archive checks the count before this function allocates memory for it.
template <typename T>
iarchive& iarchive::load(T** p, long& size) {
    const long count = static_cast<long>(read_sequence_head());
    if (*p == 0)
        *p = new T[static_cast<std::size_t>(count)];
    else if (count > size)
        throw archive_array_size_exception();
    size = count;
    detail::load_elements(*this, *p, count, typename detail::way<T>::type());
    return read_sequence_end();
}

template <typename T>
iarchive& operator>>(iarchive& ar, T& value) {
    return ar.load(value);
}
template <typename T>
iarchive& operator>>(iarchive& ar, const opros::nvp<T>& pair) {
    return ar.load(pair);
}
template <typename T>
iarchive& operator&(iarchive& ar, T& value) {
    return ar.load(value);
}
template <typename T>
iarchive& operator&(iarchive& ar, const opros::nvp<T>& pair) {
    return ar.load(pair);
}

// Boost's own pairs, for sources that include Boost.Serialization.
template <typename T>
iarchive& operator>>(iarchive& ar, const boost::serialization::nvp<T>& pair) {
    return ar.load(makenvp(pair.name(), pair.value()));
}
template <typename T>
iarchive& operator&(iarchive& ar, const boost::serialization::nvp<T>& pair) {
    return ar >> pair;
}

} // namespace archive
} // namespace opros

#endif
