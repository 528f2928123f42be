// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/transcoder.hpp"

#include "proxy/interceptor/corba/refused_value.hpp"
#include "proxy/interceptor/corba/special_values.hpp"
#include "proxy/wire/number.hpp"
#include "proxy/wire/type_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace tandem::interceptor {
namespace {

using wire::Kind;
using wire::Type;

/// Returns the minimum number of bytes of a value of `type`. With it, an element count that the message cannot hold is refused
/// before memory is allocated. Strings and sequences begin with a count of 4 bytes. For structures and arrays the result is
/// only a lower bound above 0, which suffices to limit the count.
std::size_t min_encoded_bytes(const Type& type) {
    switch (type.kind) {
    case Kind::string:
    case Kind::wide_string:
    case Kind::sequence:
    case Kind::any:
    case Kind::object:
        return 4;
    default:
        return std::max<std::size_t>(wire::primitive_size(type.kind), 1);
    }
}

void check_bound(const Type& type, std::size_t count) {
    if (type.count != 0 && count > type.count)
        throw RefusedValue(fmt::format("a {} has the length {}", wire::type_name(type), count));
}

/// The case of a union for that discriminator; nullptr if there is none, in which case the union has no member.
const Type* find_case(const Type& type, std::int64_t discriminator) {
    const auto begin = type.children.begin() + 1;
    const auto has_label = [&](const Type& each) {
        return std::find(each.labels.begin(), each.labels.end(), discriminator) != each.labels.end();
    };
    auto found = std::find_if(begin, type.children.end(), has_label);
    if (found == type.children.end())
        found =
            std::find_if(begin, type.children.end(), [](const Type& each) { return each.labels.empty(); });
    return found == type.children.end() ? nullptr : &*found;
}

/// Copies `count` primitives, swapping bytes if the sender's order is the other one.
template <class T>
void to_cdr_block(std::uint32_t count, cdrStream& from, wire::CdrWriter& to) {
    for (; count > 0; --count) {
        T value;
        from.get_octet_array(reinterpret_cast<_CORBA_Octet*>(&value), sizeof(T),
                             omni::alignment_t(wire::cdr_alignment<T>));
        if (from.unmarshal_byte_swap()) {
            auto* bytes = reinterpret_cast<std::byte*>(&value);
            std::reverse(bytes, bytes + sizeof(T));
        }
        to.put(value);
    }
}

void to_cdr_elements(const Type& element, std::uint32_t count, cdrStream& from, wire::CdrWriter& to);
void to_cdr_one(const Type& type, cdrStream& from, wire::CdrWriter& to);

/// Copies a union's discriminator and its member.
void to_cdr_union(const Type& type, cdrStream& from, wire::CdrWriter& to) {
    const Type& kind = type.children.front();
    const std::int64_t discriminator =
        kind.kind == Kind::enumeration ? read_enumerator(kind, from) : read_integer(kind.kind, from);
    put_integer(kind.kind, discriminator, to);
    if (const Type* member = find_case(type, discriminator)) to_cdr_one(*member, from, to);
}

void to_cdr_one(const Type& type, cdrStream& from, wire::CdrWriter& to) {
    switch (type.kind) {
    case Kind::structure:
        for (const Type& member : type.children) to_cdr_one(member, from, to);
        break;
    case Kind::union_type:
        return to_cdr_union(type, from, to);
    case Kind::string: {
        // The ORB allocates the string, and converts it from the connection's code set.
        const std::unique_ptr<char, void (*)(char*)> text(from.unmarshalString(static_cast<int>(type.count)),
                                                          CORBA::string_free);
        to.put_string(text.get());
        break;
    }
    case Kind::sequence: {
        CORBA::ULong count;
        count <<= from;
        check_bound(type, count);
        // Checked before the count is written: a hostile one must not make this loop write for minutes.
        const auto bytes = static_cast<CORBA::ULong>(min_encoded_bytes(type.children.front()));
        if (!from.checkInputOverrun(bytes, count)) throw_marshal();
        to.put(static_cast<std::uint32_t>(count));
        to_cdr_elements(type.children.front(), count, from, to);
        break;
    }
    case Kind::array:
        to_cdr_elements(type.children.front(), type.count, from, to);
        break;
    default:
        to_cdr_elements(type, 1, from, to);
        break;
    }
}

void to_cdr_elements(const Type& element, std::uint32_t count, cdrStream& from, wire::CdrWriter& to) {
    if (element.kind == Kind::enumeration) {
        for (; count > 0; --count) put_integer(element.kind, read_enumerator(element, from), to);
        return;
    }
    switch (wire::primitive_size(element.kind)) {
    case 1:
        return to_cdr_block<std::uint8_t>(count, from, to);
    case 2:
        return to_cdr_block<std::uint16_t>(count, from, to);
    case 4:
        return to_cdr_block<std::uint32_t>(count, from, to);
    case 8:
        return to_cdr_block<std::uint64_t>(count, from, to);
    case 16:
        return to_cdr_block<long double>(count, from, to);
    default:
        break;
    }
    const bool special = is_special(element.kind);
    for (; count > 0; --count) special ? special_to_cdr(element, from, to) : to_cdr_one(element, from, to);
}

void from_cdr_elements(const Type& element, std::uint32_t count, wire::CdrReader& from, cdrStream& to);
void from_cdr_one(const Type& type, wire::CdrReader& from, cdrStream& to);

void from_cdr_union(const Type& type, wire::CdrReader& from, cdrStream& to) {
    const Type& discriminator = type.children.front();
    const std::size_t position = from.position();
    const std::int64_t value = wire::get_integer(discriminator.kind, from);
    from.seek(position);
    from_cdr_one(discriminator, from, to);
    if (const Type* member = find_case(type, value)) from_cdr_one(*member, from, to);
}

void from_cdr_one(const Type& type, wire::CdrReader& from, cdrStream& to) {
    switch (type.kind) {
    case Kind::structure:
        for (const Type& member : type.children) from_cdr_one(member, from, to);
        break;
    case Kind::union_type:
        return from_cdr_union(type, from, to);
    case Kind::string: {
        const std::string text(from.get_string());
        check_bound(type, text.size());
        if (text.find('\0') != std::string::npos) throw RefusedValue("a string contains a NUL");
        to.marshalString(text.c_str());
        break;
    }
    case Kind::sequence: {
        // get_count() refuses what the message cannot hold.
        const CORBA::ULong count = from.get_count(min_encoded_bytes(type.children.front()));
        check_bound(type, count);
        if (!from.ok()) throw_marshal();
        count >>= to;
        from_cdr_elements(type.children.front(), count, from, to);
        break;
    }
    case Kind::array:
        from_cdr_elements(type.children.front(), type.count, from, to);
        break;
    default:
        from_cdr_elements(type, 1, from, to);
        break;
    }
    if (!from.ok()) throw_marshal();
}

void from_cdr_elements(const Type& element, std::uint32_t count, wire::CdrReader& from, cdrStream& to) {
    if (element.kind == Kind::enumeration) {
        for (; count > 0; --count) write_enumerator(element, wire::get_integer(element.kind, from), to);
        if (!from.ok()) throw_marshal();
        return;
    }
    if (const auto size = wire::primitive_size(element.kind)) {
        if (count == 0) return; // an empty sequence is not followed by padding
        // Primitives are contiguous in both formats, so one copy is enough for all of them.
        const auto alignment = wire::primitive_alignment(element.kind);
        const auto block = from.get_block(size * count, alignment);
        if (block.empty()) throw_marshal();
        to.put_octet_array(reinterpret_cast<const _CORBA_Octet*>(block.data()),
                           static_cast<int>(block.size()), omni::alignment_t(alignment));
        return;
    }
    const bool special = is_special(element.kind);
    for (; count > 0; --count)
        special ? special_from_cdr(element, from, to) : from_cdr_one(element, from, to);
}

} // namespace

void to_cdr(const Type& message, cdrStream& from, wire::CdrWriter& to) { to_cdr_one(message, from, to); }
void from_cdr(const Type& message, wire::CdrReader& from, cdrStream& to) { from_cdr_one(message, from, to); }

} // namespace tandem::interceptor
