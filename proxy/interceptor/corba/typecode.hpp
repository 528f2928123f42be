// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <omniORB4/CORBA.h>

#include <string>

namespace tandem::interceptor {

/// Returns the message type for values of a TypeCode. Throws wire::SignatureError if its nesting is too deep.
wire::Type type_of(CORBA::TypeCode_ptr code);

/// Returns the repository id that omniidl gives `Module::Name` without a pragma prefix: `IDL:Module/Name:1.0`.
std::string repository_id(std::string name);

/// Returns the type of an any's value, with its repository ids. Throws wire::SignatureError or CORBA::SystemException if it
/// is too deep or too large, or contradicts itself.
wire::Type any_type_of(CORBA::TypeCode_ptr code);

/// Returns the TypeCode of an any's value. It is equivalent to the sender's if the type has its repository ids. Throws
/// CORBA::SystemException for types without a TypeCode, and for invalid ids and names.
CORBA::TypeCode_ptr any_typecode_of(const wire::Type& value);

} // namespace tandem::interceptor
