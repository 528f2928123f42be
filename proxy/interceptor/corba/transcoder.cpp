// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/transcoder.hpp"

#include <algorithm>
#include <memory>

namespace tandem::interceptor {
namespace {

using wire::Kind;
using wire::Type;

[[noreturn]] void throw_marshal() { throw CORBA::MARSHAL(0, CORBA::COMPLETED_NO); }

/// The bytes that a value of `type` takes at least: with it, an element count that the message cannot hold is
/// refused before anything is allocated for it. Strings and sequences begin with a count of 4 bytes; of structures
/// and arrays only that they are not empty is used, which is enough to bound the count.
std::size_t min_encoded_bytes(const Type& type) {
    const auto primitive = wire::primitive_size(type.kind);
    return primitive ? primitive : type.kind == Kind::structure || type.kind == Kind::array ? 1 : 4;
}

/// Copies `count` primitives, swapping bytes if the sender's order is the other one.
template <class T>
void to_cdr_block(std::uint32_t count, cdrStream& from, wire::CdrWriter& to) {
    for (; count > 0; --count) {
        T value;
        from.get_octet_array(reinterpret_cast<_CORBA_Octet*>(&value), sizeof(T),
                             omni::alignment_t(sizeof(T)));
        if (from.unmarshal_byte_swap()) {
            auto* bytes = reinterpret_cast<std::byte*>(&value);
            std::reverse(bytes, bytes + sizeof(T));
        }
        to.put(value);
    }
}

void to_cdr_elements(const Type& element, std::uint32_t count, cdrStream& from, wire::CdrWriter& to);

void to_cdr_one(const Type& type, cdrStream& from, wire::CdrWriter& to) {
    switch (type.kind) {
    case Kind::structure:
        for (const Type& member : type.children) to_cdr_one(member, from, to);
        break;
    case Kind::string: {
        // The ORB allocates the string, and converts it from the connection's code set.
        const std::unique_ptr<char, void (*)(char*)> text(from.unmarshalString(), CORBA::string_free);
        to.put_string(text.get());
        break;
    }
    case Kind::sequence: {
        CORBA::ULong count;
        count <<= from;
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
    switch (wire::primitive_size(element.kind)) {
    case 1:
        return to_cdr_block<std::uint8_t>(count, from, to);
    case 2:
        return to_cdr_block<std::uint16_t>(count, from, to);
    case 4:
        return to_cdr_block<std::uint32_t>(count, from, to);
    case 8:
        return to_cdr_block<std::uint64_t>(count, from, to);
    default:
        break;
    }
    if (element.kind == Kind::wide_string) throw_marshal();
    for (; count > 0; --count) to_cdr_one(element, from, to);
}

void from_cdr_elements(const Type& element, std::uint32_t count, wire::CdrReader& from, cdrStream& to);

void from_cdr_one(const Type& type, wire::CdrReader& from, cdrStream& to) {
    switch (type.kind) {
    case Kind::structure:
        for (const Type& member : type.children) from_cdr_one(member, from, to);
        break;
    case Kind::string:
        to.marshalString(std::string(from.get_string()).c_str());
        break;
    case Kind::sequence: {
        // get_count() refuses what the message cannot hold.
        const CORBA::ULong count = from.get_count(min_encoded_bytes(type.children.front()));
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
    if (const auto size = wire::primitive_size(element.kind)) {
        if (count == 0) return; // an empty sequence is not followed by padding
        // Primitives lie in a row in both formats: one copy for all of them.
        const auto block = from.get_block(size * count, size);
        if (block.empty()) throw_marshal();
        to.put_octet_array(reinterpret_cast<const _CORBA_Octet*>(block.data()),
                           static_cast<int>(block.size()), omni::alignment_t(size));
        return;
    }
    if (element.kind == Kind::wide_string) throw_marshal();
    for (; count > 0; --count) from_cdr_one(element, from, to);
}

} // namespace

void to_cdr(const Type& message, cdrStream& from, wire::CdrWriter& to) { to_cdr_one(message, from, to); }
void from_cdr(const Type& message, wire::CdrReader& from, cdrStream& to) { from_cdr_one(message, from, to); }

} // namespace tandem::interceptor
