// SPDX-License-Identifier: Apache-2.0
// Functions that differ by the kind of a type. The switches have no default, so that the compiler reports a new Kind here,
// and a visitor without a function for it where the visitor is used.
#pragma once

#include "proxy/wire/type.hpp"

#include <cstdint>
#include <utility>

namespace tandem::wire {

/// Calls the visitor's function for the kind, with these arguments, and returns its result. A visitor has the functions
/// below; all of them return the same type. number<T>() is for numbers except enumerations; T is the C++ type, which for a
/// character is signed char.
template <class Visitor, class... Arguments>
decltype(auto) visit(Kind kind, Visitor&& visitor, Arguments&&... arguments) {
    switch (kind) {
    case Kind::boolean:
        return visitor.template number<bool>(std::forward<Arguments>(arguments)...);
    case Kind::character:
        return visitor.template number<signed char>(std::forward<Arguments>(arguments)...);
    case Kind::octet:
        return visitor.template number<std::uint8_t>(std::forward<Arguments>(arguments)...);
    case Kind::int16:
        return visitor.template number<std::int16_t>(std::forward<Arguments>(arguments)...);
    case Kind::uint16:
        return visitor.template number<std::uint16_t>(std::forward<Arguments>(arguments)...);
    case Kind::int32:
        return visitor.template number<std::int32_t>(std::forward<Arguments>(arguments)...);
    case Kind::uint32:
        return visitor.template number<std::uint32_t>(std::forward<Arguments>(arguments)...);
    case Kind::int64:
        return visitor.template number<std::int64_t>(std::forward<Arguments>(arguments)...);
    case Kind::uint64:
        return visitor.template number<std::uint64_t>(std::forward<Arguments>(arguments)...);
    case Kind::float32:
        return visitor.template number<float>(std::forward<Arguments>(arguments)...);
    case Kind::float64:
        return visitor.template number<double>(std::forward<Arguments>(arguments)...);
    case Kind::long_double:
        return visitor.template number<long double>(std::forward<Arguments>(arguments)...);
    case Kind::enumeration:
        return visitor.enumeration(std::forward<Arguments>(arguments)...);
    case Kind::wide_character:
        return visitor.wide_character(std::forward<Arguments>(arguments)...);
    case Kind::string:
        return visitor.string(std::forward<Arguments>(arguments)...);
    case Kind::wide_string:
        return visitor.wide_string(std::forward<Arguments>(arguments)...);
    case Kind::fixed:
        return visitor.fixed(std::forward<Arguments>(arguments)...);
    case Kind::any:
        return visitor.any(std::forward<Arguments>(arguments)...);
    case Kind::object:
        return visitor.object(std::forward<Arguments>(arguments)...);
    case Kind::sequence:
        return visitor.sequence(std::forward<Arguments>(arguments)...);
    case Kind::array:
        return visitor.array(std::forward<Arguments>(arguments)...);
    case Kind::structure:
        return visitor.structure(std::forward<Arguments>(arguments)...);
    case Kind::union_type:
        return visitor.union_type(std::forward<Arguments>(arguments)...);
    case Kind::unsupported:
        break;
    }
    return visitor.unsupported(std::forward<Arguments>(arguments)...);
}

namespace detail {

template <class Use, class Result>
struct NumberVisitor {
    Use& use;
    const Result& otherwise;

    template <class T>
    Result number() const {
        return use(T{});
    }
    Result enumeration() const { return use(std::uint32_t{}); }
    Result wide_character() const { return otherwise; }
    Result string() const { return otherwise; }
    Result wide_string() const { return otherwise; }
    Result fixed() const { return otherwise; }
    Result any() const { return otherwise; }
    Result object() const { return otherwise; }
    Result sequence() const { return otherwise; }
    Result array() const { return otherwise; }
    Result structure() const { return otherwise; }
    Result union_type() const { return otherwise; }
    Result unsupported() const { return otherwise; }
};

} // namespace detail

/// Calls `use` with a value of the C++ type for numbers of this kind, and returns its result. For kinds that are not
/// numbers (see is_number()), returns `otherwise`.
template <class Result, class Use>
Result visit_number(Kind kind, const Result& otherwise, Use use) {
    return visit(kind, detail::NumberVisitor<Use, Result>{use, otherwise});
}

} // namespace tandem::wire
