// SPDX-License-Identifier: Apache-2.0
// The names of data types on ports. Built-in and standard types have their names here. A user's type X gets one from
// `std::string typeName(X*)` in the namespace of X, otherwise its C++ name is used.
#ifndef OPROS_ARCHIVE_TYPE_INFO_H
#define OPROS_ARCHIVE_TYPE_INFO_H

#include <archive/opros_type_traits.h>

#include <complex>
#include <deque>
#include <iostream>
#include <list>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <valarray>
#include <vector>

/// Returns the name of T on ports: its typeName(), "Enum" for an enumeration, otherwise its C++ name.
template <typename T>
std::string getTypeName(T* unused = 0);

namespace opros {
/// Returns a readable name such as "std::vector<Point>" for the implementation's name of the type.
std::string readable_name(const std::type_info& type);

namespace detail {

/// std::true_type for std::queue, std::stack and std::priority_queue, which it recognizes by their members. Their
/// headers are not included: some components define their own `queue` and use `using namespace std`.
template <typename T>
struct is_container_adaptor {
    template <typename U>
    static auto test(int)
        -> decltype(std::declval<U&>().push(std::declval<const typename U::container_type::value_type&>()),
                    std::declval<U&>().pop(), std::true_type());
    template <typename U>
    static std::false_type test(long);
    static const bool value = decltype(test<T>(0))::value;
};
template <typename T>
using if_container_adaptor = typename std::enable_if<is_container_adaptor<T>::value>::type;

} // namespace detail
} // namespace opros

inline std::string typeName(bool*) { return "bool"; }
inline std::string typeName(short*) { return "short"; }
inline std::string typeName(unsigned short*) { return "unsigned short"; }
inline std::string typeName(int*) { return "int"; }
inline std::string typeName(unsigned int*) { return "unsigned int"; }
inline std::string typeName(long*) { return "long"; }
inline std::string typeName(unsigned long*) { return "unsigned long"; }
inline std::string typeName(long long*) { return "long long"; }
inline std::string typeName(unsigned long long*) { return "unsigned long long"; }
inline std::string typeName(float*) { return "float"; }
inline std::string typeName(double*) { return "double"; }
inline std::string typeName(long double*) { return "long double"; }
inline std::string typeName(char*) { return "char"; }
inline std::string typeName(signed char*) { return "signed char"; }
inline std::string typeName(unsigned char*) { return "unsigned char"; }
inline std::string typeName(wchar_t*) { return "w_char_t"; }
inline std::string typeName(std::string*) { return "std::string"; }
// A template, because components defined this function themselves when upstream did not.
template <typename Traits, typename A>
std::string typeName(std::basic_string<wchar_t, Traits, A>*) {
    return "std::wstring";
}

// Containers, named by their elements. Comparison, hash and allocator are not part of the name.
#define OPROS_TYPE_NAME_OF_1(container)                                                                      \
    template <typename T>                                                                                    \
    std::string typeName(std::container<T>*) {                                                               \
        return "std::" #container "<" + getTypeName<T>() + ">";                                              \
    }
#define OPROS_TYPE_NAME_OF_2(container)                                                                      \
    template <typename K, typename T>                                                                        \
    std::string typeName(std::container<K, T>*) {                                                            \
        return "std::" #container "<" + getTypeName<K>() + "," + getTypeName<T>() + ">";                     \
    }
OPROS_TYPE_NAME_OF_1(vector)
OPROS_TYPE_NAME_OF_1(deque)
OPROS_TYPE_NAME_OF_1(list)
OPROS_TYPE_NAME_OF_1(set)
OPROS_TYPE_NAME_OF_1(multiset)
OPROS_TYPE_NAME_OF_1(complex)
OPROS_TYPE_NAME_OF_1(valarray)
OPROS_TYPE_NAME_OF_2(map)
OPROS_TYPE_NAME_OF_2(multimap)
OPROS_TYPE_NAME_OF_2(pair)
#undef OPROS_TYPE_NAME_OF_1
#undef OPROS_TYPE_NAME_OF_2

// std::queue and std::stack, then std::priority_queue, named by the template and their elements.
template <template <typename, typename> class Adaptor, typename T,
          typename = opros::detail::if_container_adaptor<Adaptor<T, std::deque<T>>>>
std::string typeName(Adaptor<T, std::deque<T>>*) {
    const std::string name = opros::readable_name(typeid(Adaptor<T, std::deque<T>>));
    return name.substr(0, name.find('<')) + "<" + getTypeName<T>() + ">";
}
template <template <typename, typename, typename> class Adaptor, typename T,
          typename = opros::detail::if_container_adaptor<Adaptor<T, std::vector<T>, std::less<T>>>>
std::string typeName(Adaptor<T, std::vector<T>, std::less<T>>*) {
    const std::string name = opros::readable_name(typeid(Adaptor<T, std::vector<T>, std::less<T>>));
    return name.substr(0, name.find('<')) + "<" + getTypeName<T>() + ">";
}

// A pointer has a name for messages, but cannot be archived.
template <typename T>
std::string typeName(T**) {
    return getTypeName<T>() + "*";
}

/// Sets the name of a user's class on ports.
#define DEFINE_CLASS_TYPE_NAME(a)                                                                            \
    inline std::string typeName(a*) { return std::string(#a); }

namespace opros {
namespace detail {

// Overload rank: prefers an existing typeName() to the readable C++ name.
template <typename T>
auto name_of(T* p, int) -> decltype(std::string(typeName(p))) {
    return typeName(p);
}
template <typename T>
std::string name_of(T*, long) {
    return readable_name(typeid(T));
}

// void has no pointer for typeName(). All enumerations share one name, as in upstream.
template <typename T, bool is_enumeration>
struct name_selector {
    static std::string name() { return name_of(static_cast<T*>(0), 0); }
};
template <>
struct name_selector<void, false> {
    static std::string name() { return "void"; }
};
template <typename T>
struct name_selector<T, true> {
    static std::string name() { return "Enum"; }
};

} // namespace detail
} // namespace opros

template <typename T>
std::string getTypeName(T*) {
    typedef typename std::remove_cv<T>::type type;
    return opros::detail::name_selector<type, std::is_enum<type>::value>::name();
}

#endif
