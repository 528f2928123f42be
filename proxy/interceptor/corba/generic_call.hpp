// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/operation.hpp"

#include <omniORB4/CORBA.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace tandem::interceptor {

/// Why generic_call() has no results.
struct GenericCallFailure {
    /// unreachable: nobody executed the call.
    enum class Status { no_such_operation, bad_arguments, exception, unreachable, timeout } status{};
    std::string text; ///< what went wrong, one line
    std::string
        exception_id{}; ///< repository id of a user or system exception of the object; empty otherwise
    std::span<const std::byte> fields{}; ///< CDR: of a declared exception
};

/// Calls an operation of any CORBA object without a compiled stub. Arguments and results are in CDR, the results in
/// `memory`; nothing, and `failure`, when there are none. Blocks the calling thread, for a remote object at most
/// `timeout`; a co-located one is called directly, a oneway operation included. Throws nothing. [any-thread]
std::optional<std::span<const std::byte>>
generic_call(CORBA::Object_ptr object, const std::string& name, const wire::Operation& operation,
             std::span<const std::byte> arguments, std::chrono::milliseconds timeout,
             wire::MessageBuffer& memory, std::optional<GenericCallFailure>& failure);

} // namespace tandem::interceptor
