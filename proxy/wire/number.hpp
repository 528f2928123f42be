// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/type.hpp"

#include <string>
#include <string_view>

namespace tandem::wire {

/// Returns whether values of this kind are numbers: integers, floating point, enumerations, octets, chars and booleans.
bool is_number(Kind kind);

/// Reads the next number; exact for every kind, because long double has 64 bits of mantissa here.
long double get_number(Kind kind, CdrReader& in);

/// Writes the number, rounded to the nearest if the kind has no fractions. Returns false if the kind cannot hold it: out of
/// range, or not a number.
bool put_number(Kind kind, long double value, CdrWriter& out);

/// Returns whether the text is a decimal number that a fixed of this type holds without rounding.
bool is_fixed(std::string_view text, const Type& fixed);
/// Returns the text for one that is not: `is '1.234': expected a decimal number of at most 3 digits, 2 after the point`.
std::string why_not_fixed(std::string_view text, const Type& fixed);

/// Reads the value of a discriminator: an integer, a char, a boolean or an enumeration.
std::int64_t get_integer(Kind kind, CdrReader& in);

} // namespace tandem::wire
