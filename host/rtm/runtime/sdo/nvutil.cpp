// SPDX-License-Identifier: Apache-2.0
#include <coil/stringutil.h>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/NVUtil.h>
#include <sstream>
#include <stdexcept>

namespace NVUtil {
namespace {

SDOPackage::NameValue named(const char* name) {
    SDOPackage::NameValue nv;
    nv.name = CORBA::string_dup(name);
    return nv;
}

void set(SDOPackage::NVList& nv, const char* name, const char* value) {
    const CORBA::Long index = find_index(nv, name);
    if (index < 0)
        CORBA_SeqUtil::push_back(nv, newNV(name, value));
    else
        nv[static_cast<CORBA::ULong>(index)].value <<= value;
}

} // namespace

SDOPackage::NameValue newNVChar(const char* name, CORBA::Char value) {
    auto nv = named(name);
    nv.value <<= CORBA::Any::from_char(value);
    return nv;
}
SDOPackage::NameValue newNVBool(const char* name, CORBA::Boolean value) {
    auto nv = named(name);
    nv.value <<= CORBA::Any::from_boolean(value);
    return nv;
}
SDOPackage::NameValue newNVOctet(const char* name, CORBA::Octet value) {
    auto nv = named(name);
    nv.value <<= CORBA::Any::from_octet(value);
    return nv;
}
SDOPackage::NameValue newNVAny(const char* name, const CORBA::Any& value) {
    auto nv = named(name);
    nv.value = value;
    return nv;
}

void copyFromProperties(SDOPackage::NVList& nv, const coil::Properties& prop) {
    nv.length(0);
    mergeFromProperties(nv, prop);
}

void mergeFromProperties(SDOPackage::NVList& nv, const coil::Properties& prop) {
    for (const auto& key : prop.propertyNames()) set(nv, key.c_str(), prop.getProperty(key).c_str());
}

// Lists come from other processes; looking a name up takes the longer the more there are.
void copyToProperties(coil::Properties& prop, const SDOPackage::NVList& nv) {
    if (nv.length() > 10000) throw CORBA::IMP_LIMIT(0, CORBA::COMPLETED_NO);
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

CORBA::Long find_index(const SDOPackage::NVList& nv, const char* name) {
    for (CORBA::ULong i = 0; i < nv.length(); ++i)
        if (std::string(nv[i].name) == name) return static_cast<CORBA::Long>(i);
    return -1;
}

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

std::string toString(const SDOPackage::NVList& nv, const char* name) {
    const CORBA::Long index = find_index(nv, name);
    const char* value = nullptr;
    if (index < 0 || !(nv[static_cast<CORBA::ULong>(index)].value >>= value)) return "";
    return value;
}

bool appendStringValue(SDOPackage::NVList& nv, const char* name, const char* value) {
    const std::string present = toString(nv, name);
    if (coil::includes(present, value, false)) return true;
    set(nv, name, present.empty() ? value : (present + "," + value).c_str());
    return true;
}

void append(SDOPackage::NVList& dest, const SDOPackage::NVList& src) {
    CORBA_SeqUtil::push_back_list(dest, src);
}

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
