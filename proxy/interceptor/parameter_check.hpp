// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <string>
#include <vector>

namespace tandem::interceptor {

/// Returns a line for each parameter that looks like one of InterceptorComp's but has no effect: a setting of a port that
/// the own table does not have or that belongs to the other side, and an unknown name that ends with the name of a port.
/// All other parameters of an RTC belong to its manager.
std::vector<std::string> find_useless_parameters(const std::vector<std::string>& parameters,
                                                 const link::PortTable& own);

} // namespace tandem::interceptor
