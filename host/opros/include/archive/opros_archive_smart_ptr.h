// SPDX-License-Identifier: Apache-2.0
// A smart pointer is archived as what it points to.
#ifndef OPROS_ARCHIVE_SMART_PTR_H
#define OPROS_ARCHIVE_SMART_PTR_H

#include <archive/opros_iarchive_stl.h>
#include <archive/opros_oarchive_stl.h>
#include <opros_smart_ptr.h>

namespace opros {

// On ports and in the bytes, the pointer and its object cannot be told apart.
template <typename T>
std::string typeName(smart_ptr<T>*) {
    return getTypeName<T>();
}

// Throws std::exception for a pointer to nothing, which has no form in the bytes.
template <typename T, typename = archive::if_serializable<T>>
void save_this(archive::oarchive& ar, smart_ptr<T>& t) {
    ar.save(*t);
}
template <typename T, typename = archive::if_serializable<T>>
void load_this(archive::iarchive& ar, smart_ptr<T>& t) {
    // In place when there is an object: all who share it see the new value.
    if (t.isNULL()) t.reset(new T());
    ar.load(*t);
}

} // namespace opros

#endif
