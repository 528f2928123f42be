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

/// Returns a TypeCode of this structure without repository ids, equivalent to any TypeCode of the same structure. A message
/// of one member stands for this member. Throws CORBA::SystemException for types without a TypeCode.
CORBA::TypeCode_ptr typecode_of(const wire::Type& message);

} // namespace tandem::interceptor
