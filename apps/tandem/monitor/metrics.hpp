// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <string>

namespace tandem::monitor {

/// Content type of metrics_text().
inline constexpr const char* metrics_type = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// Returns all counters as OpenMetrics text, version 1.0.0 (github.com/OpenObservability/OpenMetrics). Omits unreadable
/// segments and objects.
std::string metrics_text(const State& state);

} // namespace tandem::monitor
