// SPDX-License-Identifier: Apache-2.0
// Lists the members of the data types in ApiTypes.h, once for both directions. Ours.
#ifndef DEVICE_APIMEMBERS_H_
#define DEVICE_APIMEMBERS_H_

#include <archive/opros_archive.h>

#include <string>

namespace opros {
namespace detail {

template <typename Archive>
void archive_all(Archive&) {}
template <typename Archive, typename T, typename... Rest>
void archive_all(Archive& ar, T& first, Rest&... rest) {
    ar& first;
    archive_all(ar, rest...);
}

} // namespace detail
} // namespace opros

/// Defines save() and load() for these members in this order.
#define OPROS_API_MEMBERS(...)                                                                               \
    friend class opros::archive::access;                                                                     \
    void save(opros::archive::oarchive& ar, const unsigned int) {                                            \
        opros::detail::archive_all(ar, __VA_ARGS__);                                                         \
    }                                                                                                        \
    void load(opros::archive::iarchive& ar, const unsigned int) {                                            \
        opros::detail::archive_all(ar, __VA_ARGS__);                                                         \
    }

#define OPROS_API_TYPE_NAME(type)                                                                            \
    inline std::string typeName(type*) { return #type; }

#endif
