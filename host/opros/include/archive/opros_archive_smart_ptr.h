// SPDX-License-Identifier: Apache-2.0
// Archives a smart pointer as the object that it points to.
#ifndef OPROS_ARCHIVE_SMART_PTR_H
#define OPROS_ARCHIVE_SMART_PTR_H

#include <archive/opros_iarchive_stl.h>
#include <archive/opros_oarchive_stl.h>
#include <opros_smart_ptr.h>

namespace opros {

// On ports and in the bytes, a pointer and its object are indistinguishable.
template <typename T>
std::string typeName(smart_ptr<T>*) {
    return getTypeName<T>();
}

// Throws std::exception for a null pointer, which has no form in the bytes.
template <typename T, typename = archive::if_serializable<T>>
void save_this(archive::oarchive& ar, smart_ptr<T>& t) {
    ar.save(*t);
}
template <typename T, typename = archive::if_serializable<T>>
void load_this(archive::iarchive& ar, smart_ptr<T>& t) {
    // Loads in place if there is an object: all its owners see the new value.
    if (t.isNULL()) t.reset(new T());
    ar.load(*t);
}

} // namespace opros

#endif
