// SPDX-License-Identifier: Apache-2.0
// Types of OPRoS v1 are archived as in Boost.Serialization: one member template serialize() for both directions, and
// name-value pairs by its macro. Boost is not required, but components may include it.
#ifndef OPROS_ARCHIVE_BOOST_SERIALIZATION_H
#define OPROS_ARCHIVE_BOOST_SERIALIZATION_H

#include <archive/opros_archive_common.h>

#include <type_traits>
#include <utility>

#ifndef BOOST_SERIALIZATION_NVP
#define BOOST_SERIALIZATION_NVP(name) opros::makenvp(#name, name)
#endif

namespace boost {
namespace serialization {
class access; // a friend of types whose serialize() is private
template <class T>
class nvp;
} // namespace serialization
} // namespace boost

namespace opros {
namespace archive {
namespace detail {

/// Whether T has a public serialize().
template <typename T>
struct has_public_serialize {
    template <typename U>
    static auto test(int)
        -> decltype(std::declval<U&>().serialize(std::declval<oarchive&>(), 0u), std::true_type());
    template <typename U>
    static std::false_type test(long);
    static const bool value = decltype(test<T>(0))::value;
};

/// Whether T has a member of this name, accessible or not. The name is then ambiguous in a class with two bases that
/// have it.
template <typename T, bool derivable>
struct has_serialize_name : std::false_type {};
template <typename T>
struct has_serialize_name<T, true> {
    struct other {
        int serialize;
    };
    struct both : T, other {
        ~both();
    };
    template <typename U>
    static std::false_type test(decltype(&U::serialize)*);
    template <typename U>
    static std::true_type test(...);
    static const bool value = decltype(test<both>(0))::value;
};

/// Whether boost::serialization::access, which calls a private serialize(), has been included.
template <typename T, typename Access>
struct knows_boost_access {
    template <typename U>
    static auto test(int) -> decltype(sizeof(U), std::true_type());
    template <typename U>
    static std::false_type test(long);
    static const bool value = decltype(test<Access>(0))::value;
};

/// Whether T::serialize is one public function or variable, and therefore not Boost.Serialization's member template.
template <typename T>
struct has_plain_serialize {
    template <typename U>
    static auto test(int) -> decltype(&U::serialize, std::true_type());
    template <typename U>
    static std::false_type test(long);
    static const bool value = decltype(test<T>(0))::value;
};

/// Whether T has a serialize() that only Boost's access class may call, and this class is known.
template <typename T>
struct has_private_serialize {
    static const bool derivable = std::is_class<T>::value && !std::is_final<T>::value;
    static const bool value = has_serialize_name<T, derivable>::value && !has_plain_serialize<T>::value &&
                              knows_boost_access<T, boost::serialization::access>::value;
};

// Tags of two further ways (opros_serializable.h).
struct by_serialize {};
struct by_private_serialize {};

// Depends on T, because the class may be complete only where a type is archived.
template <typename T>
struct boost_access {
    typedef typename std::conditional<true, boost::serialization::access, T>::type type;
};

/// Serves both directions: serialize() uses operator&, which saves or loads according to the archive's type.
template <typename Archive, typename T>
void serialize_class(Archive& ar, T& value, by_serialize) {
    value.serialize(ar, OPROS_SERIALIZATION_VERSION);
}
template <typename Archive, typename T>
void serialize_class(Archive& ar, T& value, by_private_serialize) {
    boost_access<T>::type::serialize(ar, value, OPROS_SERIALIZATION_VERSION);
}

} // namespace detail
} // namespace archive
} // namespace opros

#endif
