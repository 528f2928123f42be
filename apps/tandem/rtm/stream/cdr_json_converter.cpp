// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/stream/cdr_json_converter.hpp"

#include "apps/tandem/output/wide_text.hpp"

#include <fmt/format.h>

#include <utility>

namespace tandem::command {
namespace {

using DynamicAny::DynAny_ptr;
using DynamicAny::DynAny_var;

/// A DynAny created here. Do not destroy its components: they are destroyed with it.
class OwnedDynAny {
  public:
    explicit OwnedDynAny(DynAny_ptr value) : value_(value) {}
    ~OwnedDynAny() { value_->destroy(); }
    OwnedDynAny(const OwnedDynAny&) = delete;
    OwnedDynAny& operator=(const OwnedDynAny&) = delete;
    DynAny_ptr get() const { return value_.in(); }

  private:
    DynAny_var value_;
};

// A typedef is a TypeCode that encloses the TypeCode of the type.
CORBA::TypeCode_var without_aliases(CORBA::TypeCode_ptr type) {
    CORBA::TypeCode_var actual = CORBA::TypeCode::_duplicate(type);
    while (actual->kind() == CORBA::tk_alias) actual = actual->content_type();
    return actual;
}

bool is_octet(CORBA::TypeCode_ptr element) { return without_aliases(element)->kind() == CORBA::tk_octet; }

Json read_value(DynAny_ptr value, const std::string& path);

// Reads all octets at once, because one DynAny per octet would take 200 times the memory of an image.
std::string read_octets(DynAny_ptr list) {
    CORBA::OctetSeq_var octets = list->get_octet_seq();
    std::string digits;
    digits.reserve(std::size_t{2} * octets->length());
    constexpr const char* hexadecimal = "0123456789abcdef";
    for (CORBA::ULong i = 0; i < octets->length(); ++i) {
        digits += hexadecimal[octets[i] >> 4];
        digits += hexadecimal[octets[i] & 15];
    }
    return digits;
}

// A DynAny has a cursor. seek() moves it, and current_component() returns the component there.
Json read_list(DynAny_ptr list, CORBA::TypeCode_ptr type, const std::string& path) {
    if (is_octet(CORBA::TypeCode_var(type->content_type()).in())) return read_octets(list);
    Json elements = Json::array();
    const CORBA::ULong count = list->component_count();
    for (CORBA::ULong i = 0; i < count; ++i) {
        list->seek(static_cast<CORBA::Long>(i));
        DynAny_var element = list->current_component();
        elements.push_back(read_value(element.in(), fmt::format("{}[{}]", path, i)));
    }
    return elements;
}

Json read_struct(DynAny_ptr value, CORBA::TypeCode_ptr type, const std::string& path) {
    Json members = Json::object();
    for (CORBA::ULong i = 0; i < type->member_count(); ++i) {
        const char* name = type->member_name(i);
        value->seek(static_cast<CORBA::Long>(i));
        DynAny_var member = value->current_component();
        members[name] = read_value(member.in(), path + "." + name);
    }
    return members;
}

// Returns the name, because an enum's number means nothing to a reader.
std::string read_enum(DynAny_ptr value, CORBA::TypeCode_ptr type, const std::string& path) {
    DynamicAny::DynEnum_var dyn_enum = DynamicAny::DynEnum::_narrow(value);
    // omniORB refuses an invalid number when it decodes: get_as_ulong() throws BAD_PARAM.
    const CORBA::ULong number = dyn_enum->get_as_ulong();
    // Checks the index again, because the error of member_name() would not contain the path.
    if (number >= type->member_count())
        throw DataConversionError(fmt::format("{}: {} is not a value of {}", path, number, type->name()));
    return type->member_name(number);
}

// Returns the discriminator as `case`, and the member that it selects, if any.
Json read_union(DynAny_ptr value, const std::string& path) {
    DynamicAny::DynUnion_var dyn_union = DynamicAny::DynUnion::_narrow(value);
    DynAny_var discriminator = dyn_union->get_discriminator();
    Json json{{"case", read_value(discriminator.in(), path + ".case")}};
    if (dyn_union->has_no_active_member()) return json;
    const std::string name = CORBA::String_var(dyn_union->member_name()).in();
    DynAny_var member = dyn_union->member();
    json[name] = read_value(member.in(), path + "." + name);
    return json;
}

std::string read_wide_string(DynAny_ptr value) {
    const CORBA::WString_var text = value->get_wstring();
    return to_utf8(std::wstring(text.in()));
}

Json read_value(DynAny_ptr value, const std::string& path) {
    const CORBA::TypeCode_var type = without_aliases(CORBA::TypeCode_var(value->type()).in());
    switch (type->kind()) {
    case CORBA::tk_short:
        return value->get_short();
    case CORBA::tk_ushort:
        return value->get_ushort();
    case CORBA::tk_long:
        return value->get_long();
    case CORBA::tk_ulong:
        return value->get_ulong();
    case CORBA::tk_longlong:
        return value->get_longlong();
    case CORBA::tk_ulonglong:
        return value->get_ulonglong();
    case CORBA::tk_float:
        return value->get_float();
    case CORBA::tk_double:
        return value->get_double();
    case CORBA::tk_boolean:
        return static_cast<bool>(value->get_boolean());
    case CORBA::tk_octet:
        return value->get_octet();
    case CORBA::tk_char:
        return std::string(1, static_cast<char>(value->get_char()));
    case CORBA::tk_wchar:
        return to_utf8(static_cast<wchar_t>(value->get_wchar()));
    case CORBA::tk_string:
        return std::string(CORBA::String_var(value->get_string()).in());
    case CORBA::tk_wstring:
        return read_wide_string(value);
    case CORBA::tk_enum:
        return read_enum(value, type.in(), path);
    case CORBA::tk_sequence:
    case CORBA::tk_array:
        return read_list(value, type.in(), path);
    case CORBA::tk_struct:
        return read_struct(value, type.in(), path);
    case CORBA::tk_union:
        return read_union(value, path);
    default:
        throw DataConversionError(path +
                                  ": types any, fixed, long double and object reference cannot be printed");
    }
}

void write_value(DynAny_ptr target, const Json& value, const std::string& path);

// For messages: a value from the command line need not be UTF-8.
std::string text_of(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Returns the number as T. Throws nlohmann's type_error if it is not a number.
template <class T>
T integer(const Json& value) {
    if (value.is_number_float()) throw DataConversionError(text_of(value) + " is not an integer");
    const bool fits = value.is_number_unsigned()
                          ? std::in_range<T>(value.get<std::uint64_t>())
                          : !value.is_number_integer() || std::in_range<T>(value.get<std::int64_t>());
    if (!fits) throw DataConversionError(text_of(value) + " does not fit");
    return value.get<T>();
}

// The reverse of read_octets(). Accepts only pairs of digits, while std::stoul also accepts signs and blanks.
CORBA::OctetSeq octets_from_hex(const std::string& digits, const std::string& path) {
    if (digits.size() % 2 != 0 || digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
        throw DataConversionError(path + ": expected pairs of hexadecimal digits");
    CORBA::OctetSeq octets;
    octets.length(static_cast<CORBA::ULong>(digits.size() / 2));
    for (CORBA::ULong i = 0; i < octets.length(); ++i)
        octets[i] = static_cast<CORBA::Octet>(std::stoul(digits.substr(std::size_t{2} * i, 2), nullptr, 16));
    return octets;
}

// A sequence gets the list's length; an array has a fixed length. Octets may be a list of numbers, or hexadecimal
// digits as from read_list().
void write_list(DynAny_ptr target, CORBA::TypeCode_ptr type, const Json& value, const std::string& path) {
    const bool as_hex = value.is_string() && is_octet(CORBA::TypeCode_var(type->content_type()).in());
    if (!value.is_array() && !as_hex) throw DataConversionError(path + ": expected a list");
    CORBA::OctetSeq octets;
    if (as_hex) octets = octets_from_hex(value.get<std::string>(), path);
    const auto count = as_hex ? octets.length() : static_cast<CORBA::ULong>(value.size());
    if (count == 0) return; // the default: an empty sequence, or an array of zeros
    if (type->kind() == CORBA::tk_sequence)
        DynamicAny::DynSequence_var(DynamicAny::DynSequence::_narrow(target))->set_length(count);
    else if (count != type->length())
        throw DataConversionError(fmt::format("{}: {} elements, expected {}", path, count, type->length()));
    for (CORBA::ULong i = 0; i < count; ++i) {
        target->seek(static_cast<CORBA::Long>(i));
        DynAny_var element = target->current_component();
        if (as_hex)
            element->insert_octet(octets[i]);
        else
            write_value(element.in(), value[i], fmt::format("{}[{}]", path, i));
    }
}

// Accepts the name, or the number that other programs write.
void write_enum(DynAny_ptr target, CORBA::TypeCode_ptr type, const Json& value, const std::string& path) {
    CORBA::ULong number = type->member_count();
    if (value.is_number_unsigned() && value.get<std::uint64_t>() < number)
        number = value.get<CORBA::ULong>();
    else if (value.is_string())
        for (number = 0; number < type->member_count(); ++number)
            if (value.get<std::string>() == type->member_name(number)) break;
    if (number >= type->member_count())
        throw DataConversionError(path + ": " + text_of(value) + " is not a value of " + type->name());
    DynamicAny::DynEnum_var(DynamicAny::DynEnum::_narrow(target))->set_as_ulong(number);
}

// Returns member_count() if the member does not exist.
CORBA::ULong member_index(CORBA::TypeCode_ptr type, const std::string& name) {
    CORBA::ULong i = 0;
    while (i < type->member_count() && name != type->member_name(i)) ++i;
    return i;
}

void write_struct(DynAny_ptr target, CORBA::TypeCode_ptr type, const Json& value, const std::string& path) {
    if (!value.is_object()) throw DataConversionError(path + ": expected {...}");
    for (const auto& [name, member_value] : value.items()) {
        const CORBA::ULong i = member_index(type, name);
        if (i == type->member_count()) throw DataConversionError(path + ": unknown member " + name);
        target->seek(static_cast<CORBA::Long>(i));
        DynAny_var member = target->current_component();
        write_value(member.in(), member_value, path + "." + name);
    }
}

// Expects the form of read_union(). An object without a member leaves the selected one at its default.
void write_union(DynAny_ptr target, const Json& value, const std::string& path) {
    if (!value.is_object() || !value.contains("case"))
        throw DataConversionError(path + ": expected {\"case\": LABEL, MEMBER: VALUE}");
    DynamicAny::DynUnion_var dyn_union = DynamicAny::DynUnion::_narrow(target);
    // A copy, because omniORB selects the member only for a discriminator other than the current one.
    const OwnedDynAny discriminator(DynAny_var(dyn_union->get_discriminator())->copy());
    write_value(discriminator.get(), value["case"], path + ".case");
    dyn_union->set_discriminator(discriminator.get());
    const std::string selected =
        dyn_union->has_no_active_member() ? "" : CORBA::String_var(dyn_union->member_name()).in();
    for (const auto& [name, member_value] : value.items()) {
        if (name == "case") continue;
        if (name != selected)
            throw DataConversionError(path + ": case " + text_of(value["case"]) + " selects " +
                                      (selected.empty() ? "no member" : "member " + selected) + ", not " +
                                      name);
        DynAny_var member = dyn_union->member();
        write_value(member.in(), member_value, path + "." + name);
    }
}

std::wstring wide_text(const Json& value) {
    const auto text = to_wide(value.get<std::string>());
    if (!text) throw DataConversionError(text_of(value) + " is not UTF-8 text with characters up to U+FFFF");
    return *text;
}

// Throws nlohmann's type_error for another JSON type. write_value() adds the path.
void write_basic(DynAny_ptr target, CORBA::TCKind kind, const Json& value) {
    switch (kind) {
    case CORBA::tk_short:
        return target->insert_short(integer<CORBA::Short>(value));
    case CORBA::tk_ushort:
        return target->insert_ushort(integer<CORBA::UShort>(value));
    case CORBA::tk_long:
        return target->insert_long(integer<CORBA::Long>(value));
    case CORBA::tk_ulong:
        return target->insert_ulong(integer<CORBA::ULong>(value));
    case CORBA::tk_longlong:
        return target->insert_longlong(integer<CORBA::LongLong>(value));
    case CORBA::tk_ulonglong:
        return target->insert_ulonglong(integer<CORBA::ULongLong>(value));
    case CORBA::tk_float:
        return target->insert_float(value.get<CORBA::Float>());
    case CORBA::tk_double:
        return target->insert_double(value.get<CORBA::Double>());
    case CORBA::tk_boolean:
        return target->insert_boolean(value.get<bool>());
    case CORBA::tk_octet:
        return target->insert_octet(integer<CORBA::Octet>(value));
    case CORBA::tk_char:
        // The first byte of the text; "" is the character 0.
        return target->insert_char(value.get<std::string>().c_str()[0]);
    case CORBA::tk_string:
        return target->insert_string(value.get<std::string>().c_str());
    case CORBA::tk_wchar:
        return target->insert_wchar(wide_text(value).c_str()[0]);
    case CORBA::tk_wstring:
        return target->insert_wstring(wide_text(value).c_str());
    default:
        throw DataConversionError("types any, fixed, long double and object reference cannot be sent");
    }
}

// Adds the path to the errors of write_basic(). A null leaves the target at its default, like a missing member.
void write_value(DynAny_ptr target, const Json& value, const std::string& path) {
    const CORBA::TypeCode_var type = without_aliases(CORBA::TypeCode_var(target->type()).in());
    if (value.is_null()) return;
    if (type->kind() == CORBA::tk_struct) return write_struct(target, type.in(), value, path);
    if (type->kind() == CORBA::tk_union) return write_union(target, value, path);
    if (type->kind() == CORBA::tk_enum) return write_enum(target, type.in(), value, path);
    if (type->kind() == CORBA::tk_sequence || type->kind() == CORBA::tk_array)
        return write_list(target, type.in(), value, path);
    try {
        write_basic(target, type->kind(), value);
    } catch (const nlohmann::json::exception&) {
        throw DataConversionError(path + ": " + text_of(value) + " has a different type");
    } catch (const DataConversionError& error) {
        throw DataConversionError(path + ": " + error.what());
    }
}

// Returns whether a plain value may represent the member. Most types of data ports have `tm` and `data`.
bool has_member(CORBA::TypeCode_ptr type, const char* name) {
    return type->kind() == CORBA::tk_struct && member_index(type, name) < type->member_count();
}

} // namespace

CdrJsonConverter::CdrJsonConverter(CORBA::ORB_ptr orb) {
    CORBA::Object_var factory = orb->resolve_initial_references("DynAnyFactory");
    factory_ = DynamicAny::DynAnyFactory::_narrow(factory.in());
}

Json CdrJsonConverter::to_json(CORBA::TypeCode_ptr type, const RTC::ByteData& bytes) const {
    cdrMemoryStream stream(bytes.getBuffer(), static_cast<std::size_t>(bytes.getDataLength()));
    stream.setByteSwapFlag(bytes.getEndian());
    try {
        const OwnedDynAny empty(factory_->create_dyn_any_from_type_code(type));
        CORBA::Any_var any = empty.get()->to_any();
        // omniORB's function to fill an Any from bare CDR. The portable IOP::Codec reads encapsulations, whose first
        // octet (the byte order) shifts the alignment of the rest.
        any->NP_unmarshalDataOnly(stream);
        const OwnedDynAny value(factory_->create_dyn_any(any.in()));
        return read_value(value.get(), type->name());
    } catch (const CORBA::Exception&) {
        throw DataConversionError(
            fmt::format("{} bytes are not a valid {}", bytes.getDataLength(), type->name()));
    }
}

RTC::ByteData CdrJsonConverter::to_cdr(CORBA::TypeCode_ptr type, const Json& value,
                                       bool little_endian) const {
    cdrMemoryStream stream;
    stream.setByteSwapFlag(little_endian);
    try {
        const OwnedDynAny target(factory_->create_dyn_any_from_type_code(type));
        const bool data_only = !value.is_object() && has_member(without_aliases(type).in(), "data");
        write_value(target.get(), data_only ? Json{{"data", value}} : value, type->name());
        CORBA::Any_var any = target.get()->to_any();
        any->NP_marshalDataOnly(stream);
    } catch (const CORBA::Exception& error) {
        throw DataConversionError(
            fmt::format("{} is not a {} ({})", text_of(value), type->name(), error._name()));
    }
    RTC::ByteData bytes;
    bytes.isLittleEndian(little_endian);
    bytes.writeData(static_cast<const unsigned char*>(stream.bufPtr()), stream.bufSize());
    return bytes;
}

} // namespace tandem::command
