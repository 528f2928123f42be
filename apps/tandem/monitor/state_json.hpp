// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/events.hpp"
#include "apps/tandem/monitor/state.hpp"
#include "apps/tandem/monitor/verdict.hpp"

#include <deque>
#include <string>

namespace tandem::monitor {

/// Returns the JSON of `/api/state` and `/api/live` in one line. Keys contain the units. docs/monitoring.md describes
/// it. `control`: object with the state of the control.
std::string state_json(const State& state, const Verdict& verdict, const std::deque<Event>& events,
                       const nlohmann::ordered_json& control);

} // namespace tandem::monitor
