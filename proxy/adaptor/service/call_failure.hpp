// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/reply.hpp"

#include <chrono>
#include <string>

namespace tandem::adaptor {

/// Returns why a call failed, for a message: the reply's own text if it has one. `call_timeout` is the longest time that
/// the caller waited.
std::string describe_failure(const link::Reply& reply, std::chrono::milliseconds call_timeout);

} // namespace tandem::adaptor
