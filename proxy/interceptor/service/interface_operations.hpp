// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <string>
#include <vector>

namespace tandem::interceptor {

/// Returns the operations of an IDL interface; empty if its IDL is not compiled into this process. Then each call shows
/// whether it fits.
std::vector<link::ServiceOperation> operations_of(const std::string& interface);

} // namespace tandem::interceptor
