// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/typecode.hpp"

#include "proxy/interceptor/corba/special_values.hpp"

#include <rtm/InterfaceSignatures.h>

#include <string>

namespace tandem::interceptor {
namespace {

using wire::Kind;
using wire::Type;

CORBA::TypeCode_ptr basic_typecode(Kind kind) {
    switch (kind) {
    case Kind::boolean:
        return CORBA::_tc_boolean;
    case Kind::character:
        return CORBA::_tc_char;
    case Kind::octet:
        return CORBA::_tc_octet;
    case Kind::int16:
        return CORBA::_tc_short;
    case Kind::uint16:
        return CORBA::_tc_ushort;
    case Kind::int32:
        return CORBA::_tc_long;
    case Kind::uint32:
    case Kind::enumeration: // the names of its enumerators do not cross
        return CORBA::_tc_ulong;
    case Kind::int64:
        return CORBA::_tc_longlong;
    case Kind::uint64:
        return CORBA::_tc_ulonglong;
    case Kind::float32:
        return CORBA::_tc_float;
    case Kind::float64:
        return CORBA::_tc_double;
    case Kind::long_double:
        return CORBA::_tc_longdouble;
    case Kind::wide_character:
        return CORBA::_tc_wchar;
    case Kind::any:
        return CORBA::_tc_any;
    default: // a union's TypeCode needs names that are not known
        throw_marshal();
    }
}

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

CORBA::TypeCode_ptr create(const Type& type) {
    switch (type.kind) {
    case Kind::structure:
        return create_structure(type);
    case Kind::sequence:
        return CORBA::TypeCode::NP_sequence_tc(type.count,
                                               CORBA::TypeCode_var(create(type.children.front())));
    case Kind::array:
        return CORBA::TypeCode::NP_array_tc(type.count, CORBA::TypeCode_var(create(type.children.front())));
    case Kind::string:
        return CORBA::TypeCode::NP_string_tc(type.count);
    case Kind::wide_string:
        return CORBA::TypeCode::NP_wstring_tc(type.count);
    case Kind::fixed:
        return CORBA::TypeCode::NP_fixed_tc(static_cast<CORBA::UShort>(type.count),
                                            static_cast<CORBA::Short>(type.scale));
    default:
        return CORBA::TypeCode::_duplicate(basic_typecode(type.kind));
    }
}

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
