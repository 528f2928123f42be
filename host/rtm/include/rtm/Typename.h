// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_TYPENAME_H
#define RTC_TYPENAME_H
#include <rtm/InterfaceSignatures.h>
#include <rtm/RTC.h>
#include <string>

/// Brings the global namespace into argument-dependent lookup: omniidl puts `Any <<= T` there, and a
/// component may include its Skel header after this one.
template <class T>
struct RtmAnyProbe : T {
    RtmAnyProbe() : T() {}
};

namespace CORBA_Util {

/// TypeCode of an IDL struct; the caller owns the reference.
template <class T>
CORBA::TypeCode_ptr typeCodeOf() {
    const RtmAnyProbe<T> probe;
    CORBA::Any any;
    any <<= probe;
    return any.type();
}

/// Repository id, `IDL:RTC/TimedLong:1.0`; the type's signature becomes known on the way.
template <class T>
const char* toRepositoryId() {
    static const std::string id = [] {
        CORBA::TypeCode_var code = typeCodeOf<T>();
        RTC::InterfaceSignatures::addType(code->id(), code.in());
        return std::string(code->id());
    }();
    return id.c_str();
}

template <class T>
const char* toTypename() {
    static const std::string name = CORBA::TypeCode_var(typeCodeOf<T>())->name();
    return name.c_str();
}

template <class T>
const char* toRepositoryIdOfStruct() {
    return toRepositoryId<T>();
}
template <class T>
const char* toTypenameOfStruct() {
    return toTypename<T>();
}

} // namespace CORBA_Util

template <class T>
const char* toTypename() {
    return CORBA_Util::toTypename<T>();
}
#endif
