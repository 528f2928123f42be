// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/typecode.hpp"

#include "proxy/interceptor/corba/special_values.hpp"
#include "proxy/wire/visit.hpp"

#include <rtm/InterfaceSignatures.h>

#include <cstdint>
#include <string>

namespace tandem::interceptor {
namespace {

using wire::Type;

CORBA::TypeCode_ptr number_typecode(bool) { return CORBA::_tc_boolean; }
CORBA::TypeCode_ptr number_typecode(signed char) { return CORBA::_tc_char; }
CORBA::TypeCode_ptr number_typecode(std::uint8_t) { return CORBA::_tc_octet; }
CORBA::TypeCode_ptr number_typecode(std::int16_t) { return CORBA::_tc_short; }
CORBA::TypeCode_ptr number_typecode(std::uint16_t) { return CORBA::_tc_ushort; }
CORBA::TypeCode_ptr number_typecode(std::int32_t) { return CORBA::_tc_long; }
CORBA::TypeCode_ptr number_typecode(std::uint32_t) { return CORBA::_tc_ulong; }
CORBA::TypeCode_ptr number_typecode(std::int64_t) { return CORBA::_tc_longlong; }
CORBA::TypeCode_ptr number_typecode(std::uint64_t) { return CORBA::_tc_ulonglong; }
CORBA::TypeCode_ptr number_typecode(float) { return CORBA::_tc_float; }
CORBA::TypeCode_ptr number_typecode(double) { return CORBA::_tc_double; }
CORBA::TypeCode_ptr number_typecode(long double) { return CORBA::_tc_longdouble; }

CORBA::TypeCode_ptr create(const Type& type);

CORBA::TypeCode_ptr create_structure(const Type& type) {
    CORBA::StructMemberSeq members;
    members.length(static_cast<CORBA::ULong>(type.children.size()));
    for (CORBA::ULong i = 0; i < members.length(); ++i) {
        const Type& member = type.children[i];
        const std::string name = member.name.empty() ? "member" + std::to_string(i + 1) : member.name;
        members[i].name = name.c_str();
        members[i].type = create(member);
    }
    int no_arguments = 0;
    const CORBA::ORB_var orb = CORBA::ORB_init(no_arguments, nullptr); // the one that is there
    return orb->create_struct_tc("", "", members);
}

/// Makes the TypeCode of a type, which the caller owns.
struct TypeCodeMaker {
    using TypeCode = CORBA::TypeCode;
    static CORBA::TypeCode_ptr copy(CORBA::TypeCode_ptr code) { return TypeCode::_duplicate(code); }
    static CORBA::TypeCode_var element(const Type& type) { return create(type.children.front()); }

    template <class T>
    CORBA::TypeCode_ptr number(const Type&) const {
        return copy(number_typecode(T{}));
    }
    // The names of the enumerators do not cross.
    CORBA::TypeCode_ptr enumeration(const Type&) const { return copy(CORBA::_tc_ulong); }
    CORBA::TypeCode_ptr wide_character(const Type&) const { return copy(CORBA::_tc_wchar); }
    CORBA::TypeCode_ptr string(const Type& type) const { return TypeCode::NP_string_tc(type.count); }
    CORBA::TypeCode_ptr wide_string(const Type& type) const { return TypeCode::NP_wstring_tc(type.count); }
    CORBA::TypeCode_ptr fixed(const Type& type) const {
        return TypeCode::NP_fixed_tc(static_cast<CORBA::UShort>(type.count),
                                     static_cast<CORBA::Short>(type.scale));
    }
    CORBA::TypeCode_ptr any(const Type&) const { return copy(CORBA::_tc_any); }
    CORBA::TypeCode_ptr sequence(const Type& type) const {
        return TypeCode::NP_sequence_tc(type.count, element(type));
    }
    CORBA::TypeCode_ptr array(const Type& type) const {
        return TypeCode::NP_array_tc(type.count, element(type));
    }
    CORBA::TypeCode_ptr structure(const Type& type) const { return create_structure(type); }
    // The TypeCodes of a union and of an interface need names that are not known.
    CORBA::TypeCode_ptr union_type(const Type&) const { throw_marshal(); }
    CORBA::TypeCode_ptr object(const Type&) const { throw_marshal(); }
    CORBA::TypeCode_ptr unsupported(const Type&) const { throw_marshal(); }
};

CORBA::TypeCode_ptr create(const Type& type) { return wire::visit(type.kind, TypeCodeMaker(), type); }

} // namespace

Type type_of(CORBA::TypeCode_ptr code) {
    return wire::parse_signature(RTC::InterfaceSignatures::signature(code));
}

CORBA::TypeCode_ptr typecode_of(const Type& message) {
    return create(message.children.size() == 1 ? message.children.front() : message);
}

std::string repository_id(std::string name) {
    for (std::size_t at; (at = name.find("::")) != std::string::npos;) name.replace(at, 2, "/");
    return "IDL:" + name + ":1.0";
}

} // namespace tandem::interceptor
