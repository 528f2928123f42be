// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/typecode.hpp"

#include "proxy/interceptor/corba/refused_value.hpp"
#include "proxy/interceptor/corba/special_values.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/visit.hpp"

#include <fmt/format.h>
#include <rtm/InterfaceSignatures.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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

/// The last id of a type: `IDL:M/Mode:1.0`, without the enumerators. Empty if it has none.
std::string own_id(const Type& type) {
    return type.ids.empty() ? "" : type.ids.back().substr(0, type.ids.back().find(' '));
}

/// Names cross only as a part of the id: `Mode` of `IDL:M/Mode:1.0`.
std::string name_in(const std::string& id) {
    const auto end = id.rfind(':'), begin = id.find_last_of("/:", end == 0 ? 0 : end - 1);
    return begin >= end ? "" : id.substr(begin + 1, end - begin - 1);
}

std::string member_name(const Type& member, std::size_t index) {
    return member.name.empty() ? "member" + std::to_string(index + 1) : member.name;
}

CORBA::TypeCode_ptr create(const Type& type);

CORBA::TypeCode_ptr create_structure(const Type& type) {
    CORBA::StructMemberSeq members;
    members.length(static_cast<CORBA::ULong>(type.children.size()));
    for (CORBA::ULong i = 0; i < members.length(); ++i) {
        members[i].name = member_name(type.children[i], i).c_str();
        members[i].type = create(type.children[i]);
    }
    const std::string id = own_id(type);
    return process_orb()->create_struct_tc(id.c_str(), name_in(id).c_str(), members);
}

/// The limit of members of a structure (proxy/wire/type.cpp), for those that a signature can have more of. Another process
/// wrote it, and the ORB compares each one with all others.
constexpr std::size_t max_members = 4096;

/// Returns the enumerators after the id; none if they are not there, or too many.
std::vector<std::string> enumerators(const Type& type) {
    std::vector<std::string> names;
    const std::string words = type.ids.empty() ? "" : type.ids.back();
    for (std::size_t begin = words.find(' '); begin < words.size() && names.size() <= max_members;) {
        const std::size_t end = words.find(',', begin + 1);
        names.push_back(words.substr(begin + 1, end - begin - 1));
        begin = end;
    }
    if (names.size() != type.count || names.size() > max_members) names.clear();
    return names;
}

/// An enumeration without the names of its values is an unsigned long.
CORBA::TypeCode_ptr create_enumeration(const Type& type) {
    const auto names = enumerators(type);
    if (names.empty()) return CORBA::TypeCode::_duplicate(CORBA::_tc_ulong);
    CORBA::EnumMemberSeq members;
    members.length(static_cast<CORBA::ULong>(names.size()));
    for (CORBA::ULong i = 0; i < members.length(); ++i) members[i] = names[i].c_str();
    const std::string id = own_id(type);
    return process_orb()->create_enum_tc(id.c_str(), name_in(id).c_str(), members);
}

/// A label is a value of the discriminator's type, that of the default case the octet 0.
CORBA::Any label_of(CORBA::TypeCode_ptr code, wire::Kind kind, std::int64_t label) {
    std::vector<std::byte> bytes;
    wire::CdrWriter writer(bytes);
    put_integer(kind, label, writer);
    cdrMemoryStream stream;
    const auto alignment = omni::alignment_t(wire::primitive_alignment(kind));
    stream.put_octet_array(reinterpret_cast<const _CORBA_Octet*>(bytes.data()),
                           static_cast<int>(bytes.size()), alignment);
    CORBA::Any any(code, nullptr); // shares the TypeCode, which may have many enumerators
    any.NP_unmarshalDataOnly(stream);
    return any;
}

CORBA::TypeCode_ptr create_union(const Type& type) {
    const Type& discriminator = type.children.front();
    const CORBA::TypeCode_var code = create(discriminator);
    CORBA::UnionMemberSeq members;
    const auto add = [&](const CORBA::Any& label, std::size_t index, const CORBA::TypeCode_var& member) {
        const CORBA::ULong at = members.length();
        if (at == max_members)
            throw RefusedValue(fmt::format("a union of an any has more than {} labels", max_members));
        members.length(at + 1);
        members[at].name = member_name(type.children[index], index - 1).c_str();
        members[at].label = label;
        members[at].type = CORBA::TypeCode::_duplicate(member.in());
    };
    for (std::size_t i = 1; i < type.children.size(); ++i) {
        const CORBA::TypeCode_var member = create(type.children[i]); // once, however many labels it has
        const auto& labels = type.children[i].labels;
        for (const auto label : labels) add(label_of(code.in(), discriminator.kind, label), i, member);
        CORBA::Any otherwise;
        otherwise <<= CORBA::Any::from_octet(0);
        if (labels.empty()) add(otherwise, i, member);
    }
    const std::string id = own_id(type);
    return process_orb()->create_union_tc(id.c_str(), name_in(id).c_str(), code.in(), members);
}

/// Makes the TypeCode of a type without its typedefs. The caller owns it.
struct TypeCodeMaker {
    using TypeCode = CORBA::TypeCode;
    static CORBA::TypeCode_ptr copy(CORBA::TypeCode_ptr code) { return TypeCode::_duplicate(code); }
    static CORBA::TypeCode_var element(const Type& type) { return create(type.children.front()); }

    template <class T>
    CORBA::TypeCode_ptr number(const Type&) const {
        return copy(number_typecode(T{}));
    }
    CORBA::TypeCode_ptr enumeration(const Type& type) const { return create_enumeration(type); }
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
    CORBA::TypeCode_ptr structure(const Type& type) const {
        return type.children.empty() ? copy(CORBA::_tc_null) : create_structure(type);
    }
    CORBA::TypeCode_ptr union_type(const Type& type) const { return create_union(type); }
    CORBA::TypeCode_ptr object(const Type& type) const {
        const std::string id = own_id(type);
        return process_orb()->create_interface_tc(id.c_str(), name_in(id).c_str());
    }
    CORBA::TypeCode_ptr unsupported(const Type&) const { throw_marshal(); }
};

/// Whether the last id is that of the type, and not of a typedef.
bool has_own_id(wire::Kind kind) {
    return kind == wire::Kind::structure || kind == wire::Kind::union_type ||
           kind == wire::Kind::enumeration || kind == wire::Kind::object;
}

CORBA::TypeCode_ptr create(const Type& type) {
    CORBA::TypeCode_var code = wire::visit(type.kind, TypeCodeMaker(), type);
    const std::size_t typedefs = type.ids.size() - (has_own_id(type.kind) && !type.ids.empty() ? 1 : 0);
    for (std::size_t i = typedefs; i > 0; --i) {
        const std::string& id = type.ids[i - 1];
        code = process_orb()->create_alias_tc(id.c_str(), name_in(id).c_str(), code.in());
    }
    return code._retn();
}

/// Gives the type of a TypeCode, and the types in it, their repository ids. Throws RefusedValue if they are too long: a
/// TypeCode contains each type once, the ids are repeated wherever it is used.
class Identification {
  public:
    void identify(Type& type, CORBA::TypeCode_ptr code) {
        CORBA::TypeCode_var inner = CORBA::TypeCode::_duplicate(code);
        for (; inner->kind() == CORBA::tk_alias; inner = inner->content_type()) add_id(type, inner->id());
        if (type.kind == wire::Kind::unsupported) return;
        if (has_own_id(type.kind)) {
            if (*inner->id() == '\0') type.ids.clear(); // the last id would be taken for the type's own
            add_id(type, inner->id());
        }
        const auto identify_child = [&](std::size_t child, CORBA::TypeCode_ptr of_child) {
            const CORBA::TypeCode_var owned = of_child;
            identify(type.children[child], owned.in());
        };
        switch (type.kind) {
        case wire::Kind::enumeration:
            for (CORBA::ULong i = 0; i < inner->member_count() && !type.ids.empty(); ++i)
                add_enumerator(type, i == 0 ? ' ' : ',', inner->member_name(i));
            return;
        case wire::Kind::sequence:
        case wire::Kind::array:
            return identify_child(0, inner->content_type());
        case wire::Kind::structure:
            for (CORBA::ULong i = 0; i < type.children.size(); ++i) identify_child(i, inner->member_type(i));
            return;
        case wire::Kind::union_type:
            identify_child(0, inner->discriminator_type());
            for (std::size_t child = 1, label = 0; child < type.children.size(); ++child) {
                identify_child(child, inner->member_type(static_cast<CORBA::ULong>(label)));
                label += std::max<std::size_t>(type.children[child].labels.size(), 1);
            }
            return;
        default:
            return;
        }
    }

  private:
    void add_id(Type& type, const char* id) {
        constexpr std::size_t max_ids = 32; // as the receiver's parser
        if (*id == '\0') return;
        if (type.ids.size() == max_ids) throw RefusedValue("a type in an any has more than 32 ids");
        count(id);
        type.ids.emplace_back(id);
    }

    void add_enumerator(Type& type, char separator, const char* name) {
        count(name);
        type.ids.back() += separator + std::string(name);
    }

    void count(std::string_view text) {
        constexpr std::size_t max_bytes = 1 << 20;
        bytes_ += text.size() + 1;
        if (bytes_ > max_bytes)
            throw RefusedValue("the repository ids and enumerators of an any's type are longer than 1 MiB");
    }

    std::size_t bytes_ = 0;
};

} // namespace

Type type_of(CORBA::TypeCode_ptr code) {
    return wire::parse_signature(RTC::InterfaceSignatures::signature(code));
}

Type any_type_of(CORBA::TypeCode_ptr code) try {
    Type type = wire::parse_any_signature(RTC::InterfaceSignatures::signature(code));
    const bool is_null = type.kind == wire::Kind::structure && type.children.empty();
    if (!is_null) Identification().identify(type, code);
    return type;
} catch (const CORBA::UserException&) { // BadKind, Bounds: invalid names have changed the signature
    throw RefusedValue("an any's TypeCode contradicts itself");
}

CORBA::TypeCode_ptr any_typecode_of(const Type& value) { return create(value); }

std::string repository_id(std::string name) {
    for (std::size_t at; (at = name.find("::")) != std::string::npos;) name.replace(at, 2, "/");
    return "IDL:" + name + ":1.0";
}

} // namespace tandem::interceptor
