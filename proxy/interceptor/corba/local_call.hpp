// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/operation.hpp"

#include <omniORB4/CORBA.h>

#include <cstddef>
#include <optional>
#include <span>

namespace tandem::interceptor {

/// Calls an object of this process as the ORB executes a request from a socket: through the object's POA and its skeleton,
/// which reads the arguments in place. Arguments and results are in CDR, the results in `memory`. Returns nothing, without
/// a call, if the reference's object is not in this process or not active. Throws what the servant throws. [any-thread]
std::optional<std::span<const std::byte>> call_local(omniObjRef& reference, const char* name,
                                                     const wire::Operation& operation,
                                                     std::span<const std::byte> arguments,
                                                     wire::MessageBuffer& memory);

} // namespace tandem::interceptor
