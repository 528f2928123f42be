// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <string>
#include <vector>

namespace tandem::interceptor {

/// The operations of an IDL interface; empty when its IDL is not compiled into this process, in which case a call itself
/// shows whether it fits.
std::vector<link::ServiceOperation> operations_of(const std::string& interface);

} // namespace tandem::interceptor
