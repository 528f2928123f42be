// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/type.hpp"

#include <omniORB4/CORBA.h>

#include <cstdint>

// Values that the ORB's streams and the link's CDR hold in different forms, for transcoder.cpp. All functions throw
// CORBA::SystemException when what they read is no such value.
namespace tandem::interceptor {

[[noreturn]] void throw_marshal();

/// Whether values of that kind have functions of their own: wide characters and strings, fixed, any, object.
bool is_special(wire::Kind kind);
void special_to_cdr(const wire::Type& type, cdrStream& from, wire::CdrWriter& to);
void special_from_cdr(const wire::Type& type, wire::CdrReader& from, cdrStream& to);

/// The value of a discriminator, which is an integer, a char, a boolean or an enumeration.
std::int64_t read_integer(wire::Kind kind, cdrStream& from);
std::int64_t get_integer(wire::Kind kind, wire::CdrReader& from);
void put_integer(wire::Kind kind, std::int64_t value, wire::CdrWriter& to);

/// The number of an enumerator, checked against the enumeration's count of them.
std::int64_t read_enumerator(const wire::Type& type, cdrStream& from);
void write_enumerator(const wire::Type& type, std::int64_t value, cdrStream& to);

} // namespace tandem::interceptor
