// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/type.hpp"

#include <omniORB4/CORBA.h>

#include <cstdint>

// Values that have different forms in the ORB's streams and in the link's CDR, for transcoder.cpp. All functions throw
// CORBA::SystemException if the bytes are not a valid value.
namespace tandem::interceptor {

[[noreturn]] void throw_marshal();

/// Returns the ORB of this process, which exists: it has made the stream of the values.
CORBA::ORB_var process_orb();

/// Returns whether values of this kind need special functions: wide characters and strings, fixed, any, object.
bool is_special(wire::Kind kind);
void special_to_cdr(const wire::Type& type, cdrStream& from, wire::CdrWriter& to);
void special_from_cdr(const wire::Type& type, wire::CdrReader& from, cdrStream& to);

/// Reads a discriminator: an integer, a char, a boolean or an enumeration.
std::int64_t read_integer(wire::Kind kind, cdrStream& from);
void put_integer(wire::Kind kind, std::int64_t value, wire::CdrWriter& to);

/// Reads the number of an enumerator and checks it against the number of enumerators.
std::int64_t read_enumerator(const wire::Type& type, cdrStream& from);
void write_enumerator(const wire::Type& type, std::int64_t value, cdrStream& to);

} // namespace tandem::interceptor
