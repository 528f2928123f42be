// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <omniORB4/CORBA.h>

#include <string>

namespace tandem::interceptor {

/// The message that values of that type are. Throws wire::SignatureError if its nesting is too deep.
wire::Type type_of(CORBA::TypeCode_ptr code);

/// The repository id that omniidl gives `Module::Name` without a pragma prefix: `IDL:Module/Name:1.0`.
std::string repository_id(std::string name);

/// A TypeCode of that structure, without repository ids, and equivalent to any of the same structure. A message of
/// one member stands for that member. Throws CORBA::SystemException for types that have none.
CORBA::TypeCode_ptr typecode_of(const wire::Type& message);

} // namespace tandem::interceptor
