// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <string>
#include <string_view>

namespace tandem::wire {

/// Returns the name of a type for log and error messages: `double`, `array of 3 float`, `string of at most 80`.
std::string type_name(const Type& type);

/// Returns a clause for a difference between two types, if one of them crosses in the form of another one: `; an any crosses as
/// a structure of a string and a sequence of octets`. Otherwise empty.
std::string crossing_hint(Kind one, Kind other);

/// Returns the signature of a message or an operation without the names of members, for log messages. Throws nothing.
std::string without_names(std::string_view signature);

/// Returns why a type cannot cross: the reason of the first Kind::unsupported in it; empty if there is none.
std::string first_unsupported(const Type& type);

/// Returns whether `to` has an equal value for each value of `from`: float in double, int16 in int32 and in double.
bool can_widen(Kind from, Kind to);

/// Returns the first member in which two messages differ that do not fit, with what to ask for:
/// `field 'velocity.va' is float here, double there: ask for widen`. The member is named, or numbered if neither side
/// has names. `sent`: whether `here` is sent. For messages that fit: the first member at another place, if both sides
/// have the same names. Empty if there is none.
std::string first_difference(const Type& here, const Type& there, bool sent);

} // namespace tandem::wire
