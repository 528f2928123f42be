// SPDX-License-Identifier: Apache-2.0
// Types of OPRoS v1 are archived the way of Boost.Serialization: one member template serialize() for both
// directions, and name-value pairs by its macro. Nothing of Boost is needed for that; components that include
// it may.
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
class access; // befriended by types whose serialize() is private
template <class T>
class nvp;
} // namespace serialization
} // namespace boost

namespace opros {
namespace archive {
namespace detail {

/// Whether T has a serialize() that everybody may call.
template <typename T>
struct has_public_serialize {
    template <typename U>
    static auto test(int)
        -> decltype(std::declval<U&>().serialize(std::declval<oarchive&>(), 0u), std::true_type());
    template <typename U>
    static std::false_type test(long);
    static const bool value = decltype(test<T>(0))::value;
};

/// Whether T has a member of this name, accessible or not: the name is then ambiguous in a class that has two
/// bases with it.
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

/// Whether boost::serialization::access, through which a private serialize() is reached, has been included.
template <typename T, typename Access>
struct knows_boost_access {
    template <typename U>
    static auto test(int) -> decltype(sizeof(U), std::true_type());
    template <typename U>
    static std::false_type test(long);
    static const bool value = decltype(test<Access>(0))::value;
};

/// Whether T::serialize is one public function or variable: then it is not the member template of Boost.Serialization.
template <typename T>
struct has_plain_serialize {
    template <typename U>
    static auto test(int) -> decltype(&U::serialize, std::true_type());
    template <typename U>
    static std::false_type test(long);
    static const bool value = decltype(test<T>(0))::value;
};

/// Whether T has a serialize() that only Boost's access class may call, and that class is known.
template <typename T>
struct has_private_serialize {
    static const bool derivable = std::is_class<T>::value && !std::is_final<T>::value;
    static const bool value = has_serialize_name<T, derivable>::value && !has_plain_serialize<T>::value &&
                              knows_boost_access<T, boost::serialization::access>::value;
};

// Tags of two more ways (opros_serializable.h).
struct by_serialize {};
struct by_private_serialize {};

// Dependent on T, because the class may be complete only where a type is archived.
template <typename T>
struct boost_access {
    typedef typename std::conditional<true, boost::serialization::access, T>::type type;
};

/// Both directions: serialize() uses operator&, which saves or loads as the archive's type says.
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
