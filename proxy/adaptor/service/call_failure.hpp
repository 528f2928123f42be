// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/reply.hpp"

#include <chrono>
#include <string>

namespace tandem::adaptor {

/// Why a call failed, for a message: the reply's own text where it has one. `call_timeout` is what the caller
/// waited at most.
std::string describe_failure(const link::Reply& reply, std::chrono::milliseconds call_timeout);

} // namespace tandem::adaptor
