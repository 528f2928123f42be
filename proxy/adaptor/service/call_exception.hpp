// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/reply.hpp"
#include "proxy/wire/operation.hpp"

#include <MethodInvokeException.h>

#include <chrono>
#include <string>

namespace tandem::adaptor {

/// Returns the exception for a failed call of `service` (port.operation). It has the id and the fields of the exception
/// that the RTC threw, or the id of the CORBA system exception for the failure.
MethodInvokeException make_exception(const std::string& service, const wire::Operation& operation,
                                     const link::Reply& reply, std::chrono::milliseconds call_timeout);

/// Returns the reply for an exception of an OPRoS method: with id and fields if the operation declares this exception with
/// fields of these types, otherwise with the text.
link::Reply make_reply(const MethodInvokeException& exception, const wire::Operation& operation);

} // namespace tandem::adaptor
