// SPDX-License-Identifier: Apache-2.0
// Which types can cross an archive, and how: by their own save()/load(), by free save_this()/load_this()
// found beside the type, by a serialize() for both directions, or as a kind that the archive handles directly.
#ifndef OPROS_ARCHIVE_SERIALIZABLE_H
#define OPROS_ARCHIVE_SERIALIZABLE_H

#include <archive/opros_access.h>
#include <archive/opros_boost_serialization.h>
#include <archive/opros_type_info.h>

#include <deque>
#include <list>
#include <map>
#include <set>
#include <type_traits>
#include <utility>
#include <valarray>
#include <vector>

namespace opros {
namespace archive {
namespace detail {

/// The standard containers. Archives treat them as sequences, not as classes.
template <typename T>
struct is_container : std::integral_constant<bool, opros::detail::is_container_adaptor<T>::value> {};
template <typename T, typename A>
struct is_container<std::vector<T, A>> : std::true_type {};
template <typename T, typename A>
struct is_container<std::deque<T, A>> : std::true_type {};
template <typename T, typename A>
struct is_container<std::list<T, A>> : std::true_type {};
template <typename T>
struct is_container<std::valarray<T>> : std::true_type {};
template <typename T, typename C, typename A>
struct is_container<std::set<T, C, A>> : std::true_type {};
template <typename T, typename C, typename A>
struct is_container<std::multiset<T, C, A>> : std::true_type {};
template <typename K, typename T, typename C, typename A>
struct is_container<std::map<K, T, C, A>> : std::true_type {};
template <typename K, typename T, typename C, typename A>
struct is_container<std::multimap<K, T, C, A>> : std::true_type {};

/// Whether T has save() and load() that `access` may call.
template <typename T>
struct has_members {
    template <typename U>
    static auto test(int)
        -> decltype(access::save(std::declval<oarchive&>(), std::declval<U&>()),
                    access::load(std::declval<iarchive&>(), std::declval<U&>()), std::true_type());
    template <typename U>
    static std::false_type test(long);
    static const bool value = decltype(test<T>(0))::value;
};

/// Whether save_this() and load_this() are found for T, in its namespace or among those of the archives.
template <typename T>
struct has_free_functions {
    template <typename U>
    static auto test(int)
        -> decltype(save_this(std::declval<oarchive&>(), std::declval<U&>()),
                    load_this(std::declval<iarchive&>(), std::declval<U&>()), std::true_type());
    template <typename U>
    static std::false_type test(long);
    static const bool value = decltype(test<T>(0))::value;
};

// Tags of the ways, which select overloads.
struct by_primitive {};
struct by_enumeration {};
struct by_array {};
struct by_members {};
struct by_free_functions {};
struct by_nothing {};

// A shorter name for the nested choices below.
template <bool condition, typename Yes, typename No>
using choose = typename std::conditional<condition, Yes, No>::type;

// Lazy, so that free functions are looked up only for types without their own save() and load().
template <typename T, bool members>
struct class_way {
    typedef by_members type;
};
template <typename T>
struct class_way<T, false> {
    typedef choose<has_free_functions<T>::value, by_free_functions,
                   choose<has_public_serialize<T>::value, by_serialize,
                          choose<has_private_serialize<T>::value, by_private_serialize, by_nothing>>>
        type;
};
/// way<T>::type is the tag of the way in which T crosses an archive.
template <typename T>
struct way {
    typedef choose<
        std::is_arithmetic<T>::value, by_primitive,
        choose<std::is_enum<T>::value, by_enumeration,
               choose<std::is_array<T>::value, by_array, typename class_way<T, has_members<T>::value>::type>>>
        type;
};

} // namespace detail

/// Whether T can be saved and loaded. For an array: whether its elements can. For a container: see if_serializable.
template <typename T>
struct is_serializable {
    typedef typename std::remove_cv<typename std::remove_all_extents<T>::type>::type element;
    static const bool value = !std::is_same<typename detail::way<element>::type, detail::by_nothing>::value;
};
// Archives have separate functions for strings. void is the result of a method without one.
template <>
struct is_serializable<std::string> {
    static const bool value = true;
};
template <>
struct is_serializable<std::wstring> {
    static const bool value = true;
};
template <>
struct is_serializable<void> {
    static const bool value = true;
};

namespace detail {

// Save and load the content of a class. The last argument is the class's way.
template <typename T>
void serialize_class(oarchive& ar, T& value, by_members) {
    access::save(ar, value);
}
template <typename T>
void serialize_class(iarchive& ar, T& value, by_members) {
    access::load(ar, value);
}
template <typename T>
void serialize_class(oarchive& ar, T& value, by_free_functions) {
    save_this(ar, value);
}
template <typename T>
void serialize_class(iarchive& ar, T& value, by_free_functions) {
    load_this(ar, value);
}
template <typename Archive, typename T>
void serialize_class(Archive&, T&, by_nothing) {
    static_assert(is_serializable<T>::value,
                  "this type has neither save()/load() nor save_this()/load_this(): it cannot be archived");
}

} // namespace detail

} // namespace archive
} // namespace opros

/// Whether the type has its own save() and load().
template <typename Type>
class has_opros_serialization {
  public:
    static bool const value = opros::archive::detail::has_members<typename std::remove_cv<
        typename std::remove_pointer<typename std::remove_reference<Type>::type>::type>::type>::value;
};

#endif
