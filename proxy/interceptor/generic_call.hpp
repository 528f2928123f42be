// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <omniORB4/CORBA.h>

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// What came of a call on a CORBA object.
struct GenericCallResult {
    enum class Status { ok, no_such_operation, bad_arguments, exception, unreachable, timeout } status{};
    std::vector<std::byte> results; ///< CDR, when ok
    std::string text;               ///< otherwise one line
};

/// Calls an operation of any CORBA object without a compiled stub. Arguments and results in CDR; user
/// exceptions are reported by their repository id. Blocks the calling thread, for a remote object `timeout`
/// at most.
GenericCallResult generic_call(CORBA::Object_ptr object, const std::string& operation,
                               const wire::Type& arguments_type, const wire::Type& result_type,
                               std::span<const std::byte> arguments, std::chrono::milliseconds timeout);

} // namespace tandem::interceptor
