// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/reply.hpp"

#include <Method.h>

#include <chrono>
#include <optional>
#include <string>

namespace tandem::adaptor {

/// The operation signature `arguments:result` of an OPRoS method, learned by letting it describe itself to a
/// SignatureArchive; nothing when one of its types cannot be serialized.
std::optional<std::string> method_signature(Method& method);

/// Returns an empty string when the peer's service port has an operation of that name and signature, or does
/// not know its operations; otherwise one line with both signatures.
std::string check_method(const link::Port& peer, const std::string& name, const std::string& signature);

/// Why a call failed, for a message: the reply's own text where it has one. `call_timeout` is what the caller
/// waited at most.
std::string describe_failure(const link::Reply& reply, std::chrono::milliseconds call_timeout);

} // namespace tandem::adaptor
