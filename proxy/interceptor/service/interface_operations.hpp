// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tandem::interceptor {

/// Returns the operations of an IDL interface; empty if its IDL is not compiled into this process. Then each call shows
/// whether it fits.
std::vector<link::ServiceOperation> operations_of(const std::string& interface);

/// Returns whether the repository id is that of an interface which an RTC calls by this name, with or without modules.
bool is_named(std::string_view id, const std::string& interface);

} // namespace tandem::interceptor
