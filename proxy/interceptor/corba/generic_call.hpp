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

/// Why generic_call() has returned no results.
struct GenericCallFailure {
    /// unreachable: nobody executed the call. bad_results: it has run, and its results cannot cross.
    enum class Status {
        no_such_operation,
        bad_arguments,
        bad_results,
        exception,
        unreachable,
        timeout
    } status{};
    std::string text; ///< what went wrong, one line
    std::string
        exception_id{}; ///< repository id of a user or system exception of the object; empty otherwise
    std::span<const std::byte> fields{}; ///< CDR: of a declared exception
};

/// Calls an operation of any CORBA object without a compiled stub. Arguments and results are in CDR, the results in
/// `memory`. Returns nothing, and sets `failure`, if there are no results. Blocks for at most `timeout` if the object is
/// remote; calls a local object directly, even for a oneway operation. Throws nothing. [any-thread]
std::optional<std::span<const std::byte>>
generic_call(CORBA::Object_ptr object, const std::string& name, const wire::Operation& operation,
             std::span<const std::byte> arguments, std::chrono::milliseconds timeout,
             wire::MessageBuffer& memory, std::optional<GenericCallFailure>& failure);

} // namespace tandem::interceptor
