// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/special_values.hpp"

#include "proxy/interceptor/corba/refused_value.hpp"
#include "proxy/interceptor/corba/transcoder.hpp"
#include "proxy/interceptor/corba/typecode.hpp"
#include "proxy/wire/number.hpp"
#include "proxy/wire/type_text.hpp"
#include "proxy/wire/visit.hpp"
#include "proxy/wire/wide_text.hpp"

#include <fmt/format.h>

#include <memory>
#include <type_traits>
#include <vector>

namespace tandem::interceptor {

using wire::Kind;
using wire::Type;

namespace {

// An any may hold an any. Another process determines the depth.
constexpr int max_nested_anys = 8;
thread_local int nested_anys = 0;
struct AnyDepth {
    AnyDepth() {
        if (++nested_anys > max_nested_anys) {
            --nested_anys;
            throw RefusedValue(fmt::format("anys are nested more than {} deep", max_nested_anys));
        }
    }
    ~AnyDepth() { --nested_anys; }
};

constexpr const char* beyond_16_bits = "a wide character is beyond U+FFFF";

void wide_string_to_cdr(const Type& type, cdrStream& from, wire::CdrWriter& to) {
    const std::unique_ptr<CORBA::WChar, void (*)(CORBA::WChar*)> text(
        from.unmarshalWString(static_cast<int>(type.count)), CORBA::wstring_free);
    std::wstring copy;
    for (const CORBA::WChar* at = text.get(); *at != 0; ++at) copy += static_cast<wchar_t>(*at);
    if (!wire::put_wide_string(to, copy)) throw RefusedValue(beyond_16_bits);
}

void fixed_to_cdr(const Type& type, cdrStream& from, wire::CdrWriter& to) {
    CORBA::Fixed value;
    value.PR_setLimits(static_cast<CORBA::UShort>(type.count), static_cast<CORBA::UShort>(type.scale));
    value <<= from;
    const CORBA::String_var text = value.NP_asString();
    to.put_string(text.in());
}

void fixed_from_cdr(const Type& type, wire::CdrReader& from, cdrStream& to) {
    const std::string text(from.get_string());
    if (!from.ok()) throw_marshal();
    if (!wire::is_fixed(text, type)) throw RefusedValue("a fixed " + wire::why_not_fixed(text, type));
    CORBA::Fixed value(text.c_str());
    value.PR_setLimits(static_cast<CORBA::UShort>(type.count), static_cast<CORBA::UShort>(type.scale));
    value >>= to;
}

/// Returns what `parse` returns, unless a value of that type cannot cross. Another process chose the type.
template <class Parse>
Type type_in_any(const Parse& parse) {
    try {
        Type type = parse();
        const std::string reason = wire::first_unsupported(type);
        if (reason.empty()) return type;
        throw RefusedValue("an any contains a type that cannot cross: " + reason);
    } catch (const wire::SignatureError& error) {
        throw RefusedValue(fmt::format("the type of an any's value cannot be read: {}", error.reason()));
    }
}

/// An any crosses as the signature of its value and the value's CDR, which is a separate message.
void any_to_cdr(cdrStream& from, wire::CdrWriter& to) {
    const AnyDepth depth;
    const CORBA::TypeCode_var code = CORBA::TypeCode::unmarshalTypeCode(from);
    const Type type = type_in_any([&] { return any_type_of(code.in()); });
    std::vector<std::byte> value;
    wire::CdrWriter writer(value);
    to_cdr(type, from, writer);
    to.put_string(wire::to_any_signature(type));
    to.put(static_cast<std::uint32_t>(value.size()));
    to.put_block(value.data(), value.size(), 1);
}

void any_from_cdr(wire::CdrReader& from, cdrStream& to) {
    const AnyDepth depth;
    const std::string signature(from.get_string());
    const auto value = from.get_block(from.get_count(1), 1);
    if (!from.ok()) throw_marshal();
    const Type type = type_in_any([&] { return wire::parse_any_signature(signature); });
    const CORBA::TypeCode_var code = any_typecode_of(type);
    CORBA::TypeCode::marshalTypeCode(code, to);
    wire::CdrReader reader(value);
    from_cdr(type, reader, to);
    if (reader.remaining() != 0)
        throw RefusedValue(fmt::format("an any's value of type '{}' has {} bytes too many",
                                       signature.substr(0, 100), reader.remaining()));
}

/// A reference crosses as the text of its IOR, or as an empty text for nil. The receiver may store it and send it back.
void object_to_cdr(cdrStream& from, wire::CdrWriter& to) {
    const CORBA::Object_var object = CORBA::Object::_unmarshalObjRef(from);
    if (CORBA::is_nil(object)) return to.put_string("");
    const CORBA::String_var text = process_orb()->object_to_string(object);
    to.put_string(text.in());
}

void object_from_cdr(wire::CdrReader& from, cdrStream& to) {
    const std::string text(from.get_string());
    // The other forms, corbaloc and corbaname, would make this process ask others for an object.
    if (!from.ok()) throw_marshal();
    if (!text.empty() && text.rfind("IOR:", 0) != 0)
        throw RefusedValue(
            fmt::format("'{}' is not an object reference: expected 'IOR:...'", text.substr(0, 40)));
    const CORBA::Object_var object =
        text.empty() ? CORBA::Object::_nil() : process_orb()->string_to_object(text.c_str());
    CORBA::Object::_marshalObjRef(object, to);
}

void check_enumerator(const Type& type, std::int64_t value) {
    if (type.count != 0 && value >= type.count)
        throw RefusedValue(fmt::format("{} is not a value of an enumeration of {}", value, type.count));
}

template <class T>
std::int64_t read_as(cdrStream& from) {
    T value;
    value <<= from;
    return static_cast<std::int64_t>(value);
}

} // namespace

CORBA::ORB_var process_orb() {
    int argc = 0;
    return CORBA::ORB_init(argc, nullptr);
}

void throw_marshal() { throw CORBA::MARSHAL(0, CORBA::COMPLETED_NO); }

bool is_special(Kind kind) {
    switch (kind) {
    case Kind::string:
    case Kind::sequence:
    case Kind::array:
    case Kind::structure:
    case Kind::union_type:
        return false;
    default:
        return wire::primitive_size(kind) == 0;
    }
}

void special_to_cdr(const Type& type, cdrStream& from, wire::CdrWriter& to) {
    switch (type.kind) {
    case Kind::wide_character:
        if (!wire::put_wide_character(to, static_cast<wchar_t>(from.unmarshalWChar())))
            throw RefusedValue(beyond_16_bits);
        return;
    case Kind::wide_string:
        return wide_string_to_cdr(type, from, to);
    case Kind::fixed:
        return fixed_to_cdr(type, from, to);
    case Kind::any:
        return any_to_cdr(from, to);
    case Kind::object:
        return object_to_cdr(from, to);
    default:
        throw_marshal();
    }
}

void special_from_cdr(const Type& type, wire::CdrReader& from, cdrStream& to) {
    switch (type.kind) {
    case Kind::wide_character: {
        const wchar_t character = wire::get_wide_character(from);
        if (!from.ok()) throw_marshal();
        return to.marshalWChar(static_cast<CORBA::WChar>(character));
    }
    case Kind::wide_string: {
        std::wstring text;
        wire::get_wide_string(from, text);
        if (!from.ok()) throw_marshal();
        const std::basic_string<CORBA::WChar> copy(text.begin(), text.end());
        if (copy.find(CORBA::WChar{0}) != copy.npos) throw RefusedValue("a wide string contains a NUL");
        return to.marshalWString(copy.c_str(), static_cast<int>(type.count));
    }
    case Kind::fixed:
        return fixed_from_cdr(type, from, to);
    case Kind::any:
        return any_from_cdr(from, to);
    case Kind::object:
        return object_from_cdr(from, to);
    default:
        throw_marshal();
    }
}

std::int64_t read_integer(Kind kind, cdrStream& from) {
    return wire::visit_number(kind, std::int64_t{0}, [&]<class T>(T) -> std::int64_t {
        if constexpr (std::is_same_v<T, bool>)
            return from.unmarshalBoolean() ? 1 : 0;
        else if constexpr (std::is_same_v<T, signed char>)
            return static_cast<signed char>(from.unmarshalChar());
        else if constexpr (std::is_same_v<T, std::uint8_t>)
            return from.unmarshalOctet();
        else if constexpr (std::is_same_v<T, std::int64_t>)
            return read_as<CORBA::LongLong>(from);
        else if constexpr (std::is_same_v<T, std::uint64_t>)
            return read_as<CORBA::ULongLong>(from);
        else
            return read_as<T>(from);
    });
}

void put_integer(Kind kind, std::int64_t value, wire::CdrWriter& to) {
    wire::visit_number(kind, 0, [&]<class T>(T) {
        if constexpr (!std::is_same_v<T, bool>)
            to.put(static_cast<T>(value));
        else
            to.put_bool(value != 0);
        return 0;
    });
}

std::int64_t read_enumerator(const Type& type, cdrStream& from) {
    const std::int64_t value = read_integer(Kind::uint32, from);
    check_enumerator(type, value);
    return value;
}

void write_enumerator(const Type& type, std::int64_t value, cdrStream& to) {
    check_enumerator(type, value);
    static_cast<CORBA::ULong>(value) >>= to;
}

} // namespace tandem::interceptor
