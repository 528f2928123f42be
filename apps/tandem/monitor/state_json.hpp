// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/events.hpp"
#include "apps/tandem/monitor/state.hpp"
#include "apps/tandem/monitor/verdict.hpp"

#include <deque>
#include <string>

namespace tandem::monitor {

/// What `/api/state` answers and `/api/live` sends, on one line; the units are in the keys. docs/monitoring.md describes it.
/// `control`: what is said of the control, an object.
std::string state_json(const State& state, const Verdict& verdict, const std::deque<Event>& events,
                       const nlohmann::ordered_json& control);

} // namespace tandem::monitor
