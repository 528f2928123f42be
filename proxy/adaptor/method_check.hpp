// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/link_handler.hpp"
#include "proxy/link/port_table.hpp"

#include <Method.h>

#include <chrono>
#include <optional>
#include <string>

namespace tandem::adaptor {

/// `arguments:result` of an OPRoS method; nothing when one of its types cannot be archived.
std::optional<std::string> signature_of(Method& method);

/// Empty when the peer's port has an operation of that name and signature, or does not know its
/// operations; otherwise one line with both signatures.
std::string check_method(const link::Port& peer, const std::string& name, const std::string& signature);

/// What went wrong with a call, for a message.
std::string describe(const link::Reply& reply, std::chrono::milliseconds call_timeout);

} // namespace tandem::adaptor
