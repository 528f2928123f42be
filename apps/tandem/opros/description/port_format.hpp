// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tandem::command {

/// Returns a table of the ports from describe_component(), with the methods of services; "no ports" if there are none.
std::string format_ports(const nlohmann::json& ports);

} // namespace tandem::command
