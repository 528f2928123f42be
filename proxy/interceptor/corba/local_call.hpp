// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/operation.hpp"

#include <omniORB4/CORBA.h>

#include <cstddef>
#include <optional>
#include <span>

namespace tandem::interceptor {

/// Calls an object of this process as the ORB executes a request from a socket, through the object's POA and its skeleton,
/// which reads the arguments where they are. Arguments and results are in CDR, the results in `memory`. Nothing: the
/// reference's object is not in this process, or not active; then nobody was called. Throws what the servant throws.
/// [any-thread]
std::optional<std::span<const std::byte>> call_local(omniObjRef& reference, const char* name,
                                                     const wire::Operation& operation,
                                                     std::span<const std::byte> arguments,
                                                     wire::MessageBuffer& memory);

} // namespace tandem::interceptor
