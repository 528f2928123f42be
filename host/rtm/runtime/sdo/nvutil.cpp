// SPDX-License-Identifier: Apache-2.0
// Lists of named values (SDOPackage::NVList), which are how properties travel in CORBA calls, as OpenRTM-aist's
// namespace NVUtil. A value is an `any`; properties are those that are strings.
#include <coil/stringutil.h>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/NVUtil.h>
#include <sstream>
#include <stdexcept>

namespace NVUtil {
namespace {

SDOPackage::NameValue without_value(const char* name) {
    SDOPackage::NameValue nv;
    nv.name = CORBA::string_dup(name);
    return nv;
}

// Replaces the value of that name, or adds it.
void set(SDOPackage::NVList& nv, const char* name, const char* value) {
    const CORBA::Long index = find_index(nv, name);
    if (index < 0)
        CORBA_SeqUtil::push_back(nv, newNV(name, value));
    else
        nv[static_cast<CORBA::ULong>(index)].value <<= value;
}

} // namespace

// Three types must be named explicitly for an `any`, because they are one C++ type: char, boolean and octet.
SDOPackage::NameValue newNVChar(const char* name, CORBA::Char value) {
    auto nv = without_value(name);
    nv.value <<= CORBA::Any::from_char(value);
    return nv;
}
SDOPackage::NameValue newNVBool(const char* name, CORBA::Boolean value) {
    auto nv = without_value(name);
    nv.value <<= CORBA::Any::from_boolean(value);
    return nv;
}
SDOPackage::NameValue newNVOctet(const char* name, CORBA::Octet value) {
    auto nv = without_value(name);
    nv.value <<= CORBA::Any::from_octet(value);
    return nv;
}
SDOPackage::NameValue newNVAny(const char* name, const CORBA::Any& value) {
    auto nv = without_value(name);
    nv.value = value;
    return nv;
}

// Leaves of the tree become values whose names are the full keys, `conf.default.gain`.
void copyFromProperties(SDOPackage::NVList& nv, const coil::Properties& prop) {
    nv.length(0);
    mergeFromProperties(nv, prop);
}

void mergeFromProperties(SDOPackage::NVList& nv, const coil::Properties& prop) {
    for (const auto& key : prop.propertyNames()) set(nv, key.c_str(), prop.getProperty(key).c_str());
}

// Skips values that are not strings. The length is bounded, because lists come from other processes and the time to
// build the tree grows with the square of the length.
void copyToProperties(coil::Properties& prop, const SDOPackage::NVList& nv) {
    constexpr CORBA::ULong max_values = 10000;
    if (nv.length() > max_values) throw CORBA::IMP_LIMIT(0, CORBA::COMPLETED_NO);
    for (CORBA::ULong i = 0; i < nv.length(); ++i) {
        const char* value = nullptr;
        if (nv[i].value >>= value) prop.setProperty(static_cast<const char*>(nv[i].name), value);
    }
}

coil::Properties toProperties(const SDOPackage::NVList& nv) {
    coil::Properties prop;
    copyToProperties(prop, nv);
    return prop;
}

// Returns -1 if there is no value of that name. If there are several, the first counts.
CORBA::Long find_index(const SDOPackage::NVList& nv, const char* name) {
    for (CORBA::ULong i = 0; i < nv.length(); ++i)
        if (std::string(nv[i].name) == name) return static_cast<CORBA::Long>(i);
    return -1;
}

// Throws std::invalid_argument when there is no value of that name.
const CORBA::Any& find(const SDOPackage::NVList& nv, const char* name) {
    const CORBA::Long index = find_index(nv, name);
    if (index < 0) throw std::invalid_argument(std::string("no value named ") + name + " in the list");
    return nv[static_cast<CORBA::ULong>(index)].value;
}

bool isString(const SDOPackage::NVList& nv, const char* name) {
    const CORBA::Long index = find_index(nv, name);
    const char* value = nullptr;
    return index >= 0 && (nv[static_cast<CORBA::ULong>(index)].value >>= value);
}

bool isStringValue(const SDOPackage::NVList& nv, const char* name, const char* value) {
    return isString(nv, name) && toString(nv, name) == value;
}

// Returns an empty string if there is no such value or it is not a string.
std::string toString(const SDOPackage::NVList& nv, const char* name) {
    const CORBA::Long index = find_index(nv, name);
    const char* value = nullptr;
    if (index < 0 || !(nv[static_cast<CORBA::ULong>(index)].value >>= value)) return "";
    return value;
}

// Adds `value` to a comma-separated list, unless it is in the list already.
bool appendStringValue(SDOPackage::NVList& nv, const char* name, const char* value) {
    const std::string present = toString(nv, name);
    if (coil::includes(present, value, false)) return true;
    set(nv, name, present.empty() ? value : (present + "," + value).c_str());
    return true;
}

void append(SDOPackage::NVList& dest, const SDOPackage::NVList& src) {
    CORBA_SeqUtil::push_back_list(dest, src);
}

// One `name: value` per line, for people.
std::ostream& dump(std::ostream& out, const SDOPackage::NVList& nv) {
    for (CORBA::ULong i = 0; i < nv.length(); ++i) {
        const char* value = nullptr;
        out << static_cast<const char*>(nv[i].name) << ": ";
        if (nv[i].value >>= value)
            out << value;
        else
            out << "(not a string)";
        out << '\n';
    }
    return out;
}
void dump(const SDOPackage::NVList& nv) { dump(std::cout, nv); }

std::string toString(const SDOPackage::NVList& nv) {
    std::ostringstream out;
    dump(out, nv);
    return out.str();
}

} // namespace NVUtil
