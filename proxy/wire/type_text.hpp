// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <string>
#include <string_view>

namespace tandem::wire {

/// What a message calls a type: `double`, `array of 3 float`, `string of at most 80`.
std::string type_name(const Type& type);

/// A signature, of a message or an operation, without the names of members, for messages. Throws nothing.
std::string without_names(std::string_view signature);

/// Why a type cannot cross: the reason of the first Kind::unsupported in it; empty if there is none.
std::string first_unsupported(const Type& type);

/// Whether each value of `from` has an equal one of `to`: float in double, int16 in int32 and in double.
bool can_widen(Kind from, Kind to);

/// The first member in which two messages that do not fit differ, by its name, or by its position where neither side
/// has names, with what to ask for: `field 'velocity.va' is float here, double there: ask for widen`. `sent` says
/// whether `here` is what is sent. Of messages that fit: the first member with another place, where both sides have the
/// same names. Empty if there is none.
std::string first_difference(const Type& here, const Type& there, bool sent);

} // namespace tandem::wire
