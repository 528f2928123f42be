// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/operation.hpp"

#include <omniORB4/CORBA.h>

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// The result of generic_call().
struct GenericCallResult {
    /// unreachable: nobody executed the call.
    enum class Status { ok, no_such_operation, bad_arguments, exception, unreachable, timeout } status{};
    std::vector<std::byte> results; ///< CDR: of the reply when ok, of the fields of a declared exception
    std::string text;               ///< what went wrong, one line; empty when ok
    std::string exception_id; ///< repository id of a user or system exception of the object; empty otherwise
};

/// Calls an operation of any CORBA object without a compiled stub. Arguments and results are in CDR. Blocks the
/// calling thread, for a remote object at most `timeout`; a co-located one is called directly, a oneway operation
/// included. Throws nothing. [any-thread]
GenericCallResult generic_call(CORBA::Object_ptr object, const std::string& name,
                               const wire::Operation& operation, std::span<const std::byte> arguments,
                               std::chrono::milliseconds timeout);

} // namespace tandem::interceptor
