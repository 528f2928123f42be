// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/type.hpp"

#include <omniORB4/CORBA.h>

namespace tandem::interceptor {

/// Converts the members of `message` from the ORB's stream, of either byte order, to little-endian CDR. Throws
/// CORBA::SystemException if the stream holds no such message: it ends early, a value is beyond its bound, or an enumerator
/// does not exist.
void to_cdr(const wire::Type& message, cdrStream& from, wire::CdrWriter& to);

/// Converts from CDR to the ORB's stream in the machine's byte order. Throws CORBA::SystemException if the CDR holds no
/// such message.
void from_cdr(const wire::Type& message, wire::CdrReader& from, cdrStream& to);

} // namespace tandem::interceptor
