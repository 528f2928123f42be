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

/// The result of generic_call().
struct GenericCallResult {
    enum class Status { ok, no_such_operation, bad_arguments, exception, unreachable, timeout } status{};
    std::vector<std::byte> results; ///< CDR, when ok
    std::string text;               ///< what went wrong, one line; empty when ok
};

/// Calls an operation of any CORBA object without a compiled stub. Arguments and results are in CDR. A user
/// exception is reported by its repository id. Blocks the calling thread, for a remote object at most
/// `timeout`; a co-located one is called directly. Throws nothing. [any-thread]
GenericCallResult generic_call(CORBA::Object_ptr object, const std::string& operation,
                               const wire::Type& arguments_type, const wire::Type& result_type,
                               std::span<const std::byte> arguments, std::chrono::milliseconds timeout);

} // namespace tandem::interceptor
