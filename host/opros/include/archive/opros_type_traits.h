// SPDX-License-Identifier: Apache-2.0
// Type traits with the names that OPRoS components use.
#ifndef OPROS_ARCHIVE_TYPE_TRAITS_H
#define OPROS_ARCHIVE_TYPE_TRAITS_H

#include <TandemAbi.h>

#include <type_traits>

namespace opros {

/// Booleans, characters and numbers, which an archive writes without help of the type.
template <typename T>
struct is_primitive {
    enum { value = std::is_arithmetic<T>::value };
};
template <typename T>
struct is_array {
    enum { value = std::is_array<T>::value };
};
template <typename T>
struct is_pointer {
    enum { value = std::is_pointer<T>::value };
};
/// A class, struct or union.
template <typename T>
struct is_class {
    enum { value = std::is_class<T>::value || std::is_union<T>::value };
};
template <typename T>
struct is_enum {
    enum { value = std::is_enum<T>::value };
};

// Equal to the traits of the same names in namespace std.
template <typename T>
struct remove_const {
    typedef typename std::remove_const<T>::type type;
};
template <typename T>
struct add_const {
    typedef typename std::add_const<T>::type type;
};
template <typename T>
struct remove_reference {
    typedef typename std::remove_reference<T>::type type;
};
template <typename T>
struct remove_pointer {
    typedef typename std::remove_pointer<T>::type type;
};

} // namespace opros

#endif
