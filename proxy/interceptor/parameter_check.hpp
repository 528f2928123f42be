// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <string>
#include <vector>

namespace tandem::interceptor {

/// Returns a line for each parameter that has no effect: a setting of a port that this side's table does not have or that
/// belongs to the other side, and a name that neither InterceptorComp nor a manager knows.
std::vector<std::string> find_useless_parameters(const std::vector<std::string>& parameters,
                                                 const link::PortTable& own);

} // namespace tandem::interceptor
