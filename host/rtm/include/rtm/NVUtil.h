// SPDX-License-Identifier: Apache-2.0
// Functions for lists of named CORBA values (SDOPackage::NVList): create, find, and convert to and from
// coil::Properties.
#ifndef NVUTIL_NVUTIL_H
#define NVUTIL_NVUTIL_H
#include <coil/Properties.h>
#include <iostream>
#include <rtm/idl/SDOPackageSkel.h>
#include <string>

namespace NVUtil {

template <class Value>
SDOPackage::NameValue newNV(const char* name, Value value) {
    SDOPackage::NameValue nv;
    nv.name = CORBA::string_dup(name);
    nv.value <<= value;
    return nv;
}
SDOPackage::NameValue newNVChar(const char* name, CORBA::Char value);
SDOPackage::NameValue newNVBool(const char* name, CORBA::Boolean value);
SDOPackage::NameValue newNVOctet(const char* name, CORBA::Octet value);
SDOPackage::NameValue newNVAny(const char* name, const CORBA::Any& value);

/// Replaces the list by the properties, all as strings.
void copyFromProperties(SDOPackage::NVList& nv, const coil::Properties& prop);
/// Sets the properties in the list and keeps its other entries.
void mergeFromProperties(SDOPackage::NVList& nv, const coil::Properties& prop);
/// Converts the strings of the list to properties. Skips values of other types.
void copyToProperties(coil::Properties& prop, const SDOPackage::NVList& nv);
coil::Properties toProperties(const SDOPackage::NVList& nv);

/// Throws std::invalid_argument with the name if there is no such value.
const CORBA::Any& find(const SDOPackage::NVList& nv, const char* name);
/// Returns -1 if there is none.
CORBA::Long find_index(const SDOPackage::NVList& nv, const char* name);
bool isString(const SDOPackage::NVList& nv, const char* name);
bool isStringValue(const SDOPackage::NVList& nv, const char* name, const char* value);
std::string toString(const SDOPackage::NVList& nv, const char* name);
/// Adds `value` to a comma-separated list unless it is already in it.
bool appendStringValue(SDOPackage::NVList& nv, const char* name, const char* value);
void append(SDOPackage::NVList& dest, const SDOPackage::NVList& src);
std::ostream& dump(std::ostream& out, const SDOPackage::NVList& nv);
void dump(const SDOPackage::NVList& nv);
std::string toString(const SDOPackage::NVList& nv);
inline std::ostream& dump_to_stream(std::ostream& out, const SDOPackage::NVList& nv) { return dump(out, nv); }
inline std::ostream& operator<<(std::ostream& out, const SDOPackage::NVList& nv) { return dump(out, nv); }

} // namespace NVUtil
#endif
