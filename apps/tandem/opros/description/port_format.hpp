// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tandem::command {

/// A table of ports as describe_component() gives them, services with their methods; "no ports" if there are none.
std::string format_ports(const nlohmann::json& ports);

} // namespace tandem::command
