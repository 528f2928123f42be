// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/stream/cdr_json.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace tandem::command {
namespace {

Json read(CORBA::TypeCode_ptr type, cdrStream& in, const std::string& place);

template <class T>
Json number(cdrStream& in) {
    T value;
    value <<= in;
    return value;
}

Json read_list(CORBA::TypeCode_ptr element, CORBA::ULong count, cdrStream& in, const std::string& place) {
    const CORBA::TCKind kind = element->kind();
    if (kind == CORBA::tk_octet) {
        std::string text;
        for (CORBA::ULong i = 0; i < count; ++i) text += fmt::format("{:02x}", in.unmarshalOctet());
        return text;
    }
    Json list = Json::array();
    for (CORBA::ULong i = 0; i < count; ++i)
        list.push_back(read(element, in, place + "[" + std::to_string(i) + "]"));
    return list;
}

Json read(CORBA::TypeCode_ptr type, cdrStream& in, const std::string& place) {
    switch (type->kind()) {
    case CORBA::tk_short:
        return number<CORBA::Short>(in);
    case CORBA::tk_ushort:
        return number<CORBA::UShort>(in);
    case CORBA::tk_long:
        return number<CORBA::Long>(in);
    case CORBA::tk_ulong:
        return number<CORBA::ULong>(in);
    case CORBA::tk_longlong:
        return number<CORBA::LongLong>(in);
    case CORBA::tk_ulonglong:
        return number<CORBA::ULongLong>(in);
    case CORBA::tk_float:
        return number<CORBA::Float>(in);
    case CORBA::tk_double:
        return number<CORBA::Double>(in);
    case CORBA::tk_boolean:
        return in.unmarshalBoolean();
    case CORBA::tk_octet:
        return in.unmarshalOctet();
    case CORBA::tk_char:
        return std::string(1, in.unmarshalChar());
    case CORBA::tk_wchar:
        return static_cast<unsigned>(in.unmarshalWChar());
    case CORBA::tk_string: {
        CORBA::String_var text(in.unmarshalString(0));
        return std::string(text.in());
    }
    case CORBA::tk_wstring: {
        CORBA::WString_var text(in.unmarshalWString(0));
        Json codes = Json::array();
        for (const CORBA::WChar* c = text.in(); *c != 0; ++c) codes.push_back(static_cast<unsigned>(*c));
        return codes;
    }
    case CORBA::tk_enum: {
        const CORBA::ULong value = number<CORBA::ULong>(in);
        if (value >= type->member_count())
            throw DataConversionError(fmt::format("{}: {} is no value of {}", place, value, type->name()));
        return std::string(type->member_name(value));
    }
    case CORBA::tk_alias:
        return read(CORBA::TypeCode_var(type->content_type()).in(), in, place);
    case CORBA::tk_sequence: {
        CORBA::TypeCode_var element = type->content_type();
        const CORBA::ULong count = number<CORBA::ULong>(in);
        if (!in.checkInputOverrun(1, count)) throw DataConversionError(place + ": longer than the message");
        return read_list(element.in(), count, in, place);
    }
    case CORBA::tk_array: {
        CORBA::TypeCode_var element = type->content_type();
        return read_list(element.in(), type->length(), in, place);
    }
    case CORBA::tk_struct: {
        Json members = Json::object();
        for (CORBA::ULong i = 0; i < type->member_count(); ++i) {
            CORBA::TypeCode_var member = type->member_type(i);
            members[type->member_name(i)] = read(member.in(), in, place + "." + type->member_name(i));
        }
        return members;
    }
    default:
        throw DataConversionError(place + ": a type that cannot be shown (any, union or object reference)");
    }
}

void write(CORBA::TypeCode_ptr type, const Json& value, cdrStream& out, const std::string& place);

template <class T>
void put(const Json& value, cdrStream& out) {
    if constexpr (std::is_integral_v<T>) {
        if (value.is_number_float()) throw DataConversionError(value.dump() + " is no integer");
        const bool fits = value.is_number_unsigned()
                              ? std::in_range<T>(value.get<std::uint64_t>())
                              : !value.is_number_integer() || std::in_range<T>(value.get<std::int64_t>());
        if (!fits) throw DataConversionError(value.dump() + " does not fit");
    }
    const T number = value.is_null() ? T() : value.get<T>();
    number >>= out;
}

void write_list(CORBA::TypeCode_ptr element, const Json& value, std::optional<CORBA::ULong> length,
                cdrStream& out, const std::string& place) {
    const bool as_hex = value.is_string() && element->kind() == CORBA::tk_octet;
    if (!value.is_null() && !value.is_array() && !as_hex)
        throw DataConversionError(place + ": expected a list");
    const std::string digits = as_hex ? value.get<std::string>() : "";
    if (digits.size() % 2 != 0 || digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
        throw DataConversionError(place + ": expected pairs of hexadecimal digits");
    const auto given = static_cast<CORBA::ULong>(as_hex ? digits.size() / 2 : value.size());
    if (length && given != 0 && given != *length)
        throw DataConversionError(fmt::format("{}: {} elements, expected {}", place, given, *length));
    if (!length) given >>= out;
    for (CORBA::ULong i = 0; i < length.value_or(given); ++i) {
        const Json one = given == 0 ? Json()
                         : as_hex   ? Json(std::stoul(digits.substr(i * 2, 2), nullptr, 16))
                                    : value[i];
        write(element, one, out, place + "[" + std::to_string(i) + "]");
    }
}

void write_enum(CORBA::TypeCode_ptr type, const Json& value, cdrStream& out, const std::string& place) {
    CORBA::ULong number = value.is_number_unsigned() ? value.get<CORBA::ULong>() : 0;
    if (value.is_string())
        while (number < type->member_count() && value.get<std::string>() != type->member_name(number))
            ++number;
    if (number >= type->member_count())
        throw DataConversionError(place + ": " + value.dump() + " is no value of " + type->name());
    number >>= out;
}

void write_struct(CORBA::TypeCode_ptr type, const Json& value, cdrStream& out, const std::string& place) {
    if (!value.is_null() && !value.is_object()) throw DataConversionError(place + ": expected {...}");
    for (auto it = value.begin(); value.is_object() && it != value.end(); ++it) {
        CORBA::ULong i = 0;
        while (i < type->member_count() && it.key() != type->member_name(i)) ++i;
        if (i == type->member_count()) throw DataConversionError(place + ": there is no member " + it.key());
    }
    for (CORBA::ULong i = 0; i < type->member_count(); ++i) {
        const char* name = type->member_name(i);
        const Json member = value.is_object() && value.contains(name) ? value[name] : Json();
        write(CORBA::TypeCode_var(type->member_type(i)).in(), member, out, place + "." + name);
    }
}

void write_plain(CORBA::TypeCode_ptr type, const Json& value, cdrStream& out) {
    switch (type->kind()) {
    case CORBA::tk_short:
        return put<CORBA::Short>(value, out);
    case CORBA::tk_ushort:
        return put<CORBA::UShort>(value, out);
    case CORBA::tk_long:
        return put<CORBA::Long>(value, out);
    case CORBA::tk_ulong:
        return put<CORBA::ULong>(value, out);
    case CORBA::tk_longlong:
        return put<CORBA::LongLong>(value, out);
    case CORBA::tk_ulonglong:
        return put<CORBA::ULongLong>(value, out);
    case CORBA::tk_float:
        return put<CORBA::Float>(value, out);
    case CORBA::tk_double:
        return put<CORBA::Double>(value, out);
    case CORBA::tk_boolean:
        return out.marshalBoolean(value.is_null() ? false : value.get<bool>());
    case CORBA::tk_octet:
        return out.marshalOctet(value.is_null() ? CORBA::Octet(0) : value.get<CORBA::Octet>());
    case CORBA::tk_char:
        return out.marshalChar(
            value.is_null() || value.get<std::string>().empty() ? '\0' : value.get<std::string>()[0]);
    case CORBA::tk_string:
        return out.marshalString(value.is_null() ? "" : value.get<std::string>().c_str(), 0);
    default:
        throw DataConversionError(
            "a type that cannot be given as text (any, union, wide characters, object reference)");
    }
}

void write(CORBA::TypeCode_ptr type, const Json& value, cdrStream& out, const std::string& place) {
    switch (type->kind()) {
    case CORBA::tk_alias:
        return write(CORBA::TypeCode_var(type->content_type()).in(), value, out, place);
    case CORBA::tk_struct:
        return write_struct(type, value, out, place);
    case CORBA::tk_enum:
        return write_enum(type, value, out, place);
    case CORBA::tk_sequence:
        return write_list(CORBA::TypeCode_var(type->content_type()).in(), value, std::nullopt, out, place);
    case CORBA::tk_array:
        return write_list(CORBA::TypeCode_var(type->content_type()).in(), value, type->length(), out, place);
    default:
        break;
    }
    try {
        write_plain(type, value, out);
    } catch (const nlohmann::json::exception&) {
        throw DataConversionError(place + ": " + value.dump() + " is of another type");
    } catch (const DataConversionError& e) {
        throw DataConversionError(place + ": " + e.what());
    }
}

bool has_member(CORBA::TypeCode_ptr type, const std::string& name) {
    for (CORBA::ULong i = 0; type->kind() == CORBA::tk_struct && i < type->member_count(); ++i)
        if (name == type->member_name(i)) return true;
    return false;
}

} // namespace

Json cdr_to_json(CORBA::TypeCode_ptr type, const RTC::ByteData& bytes) {
    cdrMemoryStream stream(bytes.getBuffer(), static_cast<std::size_t>(bytes.getDataLength()));
    stream.setByteSwapFlag(bytes.getEndian());
    try {
        return read(type, stream, type->name());
    } catch (const CORBA::SystemException&) {
        throw DataConversionError(
            fmt::format("{} bytes that are no {}", bytes.getDataLength(), type->name()));
    }
}

RTC::ByteData json_to_cdr(CORBA::TypeCode_ptr type, const Json& value, bool little_endian) {
    cdrMemoryStream stream;
    stream.setByteSwapFlag(little_endian);
    const bool plain = !value.is_object() && has_member(type, "data");
    write(type, plain ? Json{{"data", value}} : value, stream, type->name());
    RTC::ByteData bytes;
    bytes.isLittleEndian(little_endian);
    bytes.writeData(static_cast<const unsigned char*>(stream.bufPtr()), stream.bufSize());
    return bytes;
}

std::string hex_dump(const RTC::ByteData& bytes) {
    std::string text;
    for (unsigned long i = 0; i < bytes.getDataLength(); ++i)
        text += fmt::format("{}{:02x}", i == 0 ? "" : " ", bytes.getBuffer()[i]);
    return text;
}

} // namespace tandem::command
