// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/type.hpp"

#include <omniORB4/CORBA.h>

namespace tandem::interceptor {

/// Moves the members of `message` from a CORBA stream of either byte order into CDR. Throws CORBA::MARSHAL
/// when the stream holds less than that, and for wide strings, whose CORBA encoding depends on the
/// connection.
void to_cdr(const wire::Type& message, cdrStream& from, wire::CdrWriter& to);

/// The way back. Throws CORBA::MARSHAL when the CDR does not hold such a message.
void from_cdr(const wire::Type& message, wire::CdrReader& from, cdrStream& to);

} // namespace tandem::interceptor
