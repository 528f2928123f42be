// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/reply.hpp"
#include "proxy/wire/operation.hpp"

#include <MethodInvokeException.h>

#include <chrono>
#include <string>

namespace tandem::adaptor {

/// The exception for a call of `service` (port.operation) that failed. It has the id and the fields of the exception
/// that the RTC threw, or the id of the CORBA system exception which says how the call failed.
MethodInvokeException make_exception(const std::string& service, const wire::Operation& operation,
                                     const link::Reply& reply, std::chrono::milliseconds call_timeout);

/// The reply for what an OPRoS method threw: with id and fields if the operation declares that exception with fields of
/// these types, otherwise with the text.
link::Reply make_reply(const MethodInvokeException& exception, const wire::Operation& operation);

} // namespace tandem::adaptor
