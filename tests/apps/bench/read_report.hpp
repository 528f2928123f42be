// SPDX-License-Identifier: Apache-2.0
// Reads the JSON that tandem-bench writes.
#pragma once
#include "apps/bench/report/report.hpp"

namespace tandem::bench::test {

/// Returns the report that to_json() wrote. Throws nlohmann::json::exception if a key is missing or has another type.
Report from_json(const std::string& text);

} // namespace tandem::bench::test
