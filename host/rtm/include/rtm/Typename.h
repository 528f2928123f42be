// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_TYPENAME_H
#define RTC_TYPENAME_H
#include <rtm/InterfaceSignatures.h>
#include <rtm/RTC.h>
#include <string>

/// Adds the global namespace to argument-dependent lookup: omniidl declares `Any <<= T` there, and a component may
/// include its Skel header after this one.
template <class T>
struct RtmAnyProbe : T {
    RtmAnyProbe() : T() {}
};

/// Does the same for references to an interface: omniORB's class for them is outside the interface's namespace.
template <class T>
struct RtmAnyReference {
    operator T*() const {
        static T* const nil = new T(); // never deleted, like omniORB's own
        return nil;
    }
};

namespace CORBA_Util {

/// Returns the TypeCode of an IDL struct. The caller owns the reference.
template <class T>
CORBA::TypeCode_ptr typeCodeOf() {
    const RtmAnyProbe<T> probe;
    CORBA::Any any;
    any <<= probe;
    return any.type();
}

/// Returns the repository id of an IDL struct, `IDL:RTC/TimedLong:1.0`, and registers the type's signature.
template <class T>
const char* toRepositoryIdOfStruct() {
    static const std::string id = [] {
        CORBA::TypeCode_var code = typeCodeOf<T>();
        RTC::InterfaceSignatures::addType(code->id(), code.in());
        return std::string(code->id());
    }();
    return id.c_str();
}
template <class T>
const char* toTypenameOfStruct() {
    static const std::string name = CORBA::TypeCode_var(typeCodeOf<T>())->name();
    return name.c_str();
}

/// Returns the TypeCode of an interface by the target of its _ptr type. The caller owns the reference.
template <class T>
CORBA::TypeCode_ptr typeCodeOfReference() {
    const RtmAnyReference<T> probe;
    CORBA::Any any;
    any <<= probe;
    return any.type();
}

template <class T>
struct TargetOf;
template <class T>
struct TargetOf<T*> {
    using Type = T;
};

/// Returns the repository id of an IDL interface.
template <class T>
const char* toRepositoryIdOfObject() {
    return T::_PD_repoId;
}
template <class T>
const char* toTypenameOfObject() {
    using Target = typename TargetOf<typename T::_ptr_type>::Type;
    static const std::string name = CORBA::TypeCode_var(typeCodeOfReference<Target>())->name();
    return name.c_str();
}

template <class T, class = void>
struct NameOf { // a struct
    static const char* id() { return toRepositoryIdOfStruct<T>(); }
    static const char* name() { return toTypenameOfStruct<T>(); }
};
template <class T>
struct NameOf<T, decltype(T::_nil(), void())> { // an interface
    static const char* id() { return toRepositoryIdOfObject<T>(); }
    static const char* name() { return toTypenameOfObject<T>(); }
};
template <class T>
struct NameOf<T*, void> { // its _ptr type
    static const char* id() {
        static const std::string text = CORBA::TypeCode_var(typeCodeOfReference<T>())->id();
        return text.c_str();
    }
    static const char* name() {
        static const std::string text = CORBA::TypeCode_var(typeCodeOfReference<T>())->name();
        return text.c_str();
    }
};

template <class T>
const char* toRepositoryId() {
    return NameOf<T>::id();
}
template <class T>
const char* toTypename() {
    return NameOf<T>::name();
}

} // namespace CORBA_Util

template <class T>
const char* toTypename() {
    return CORBA_Util::toTypename<T>();
}
#endif
