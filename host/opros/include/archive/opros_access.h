// SPDX-License-Identifier: Apache-2.0
// Accesses a user type's own save() and load(). A type with private ones declares this class a friend.
#ifndef OPROS_ARCHIVE_ACCESS_H
#define OPROS_ARCHIVE_ACCESS_H

#include <archive/opros_archive_common.h>

namespace opros {
namespace archive {

/// Calls the members of a user's type, which may be private. [any-thread]
class access {
  public:
    template <typename T>
    static auto save(oarchive& ar, T& t) -> decltype(t.save(ar, OPROS_SERIALIZATION_VERSION), void()) {
        t.save(ar, OPROS_SERIALIZATION_VERSION);
    }
    template <typename T>
    static auto load(iarchive& ar, T& t) -> decltype(t.load(ar, OPROS_SERIALIZATION_VERSION), void()) {
        t.load(ar, OPROS_SERIALIZATION_VERSION);
    }
};

} // namespace archive
} // namespace opros

#endif
