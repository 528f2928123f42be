// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <string>

namespace tandem::monitor {

/// Content type of metrics_text().
inline constexpr const char* metrics_type = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// All counters as text of the OpenMetrics specification, version 1.0.0 (github.com/OpenObservability/OpenMetrics). Of
/// segments and objects that cannot be read there is nothing.
std::string metrics_text(const State& state);

} // namespace tandem::monitor
