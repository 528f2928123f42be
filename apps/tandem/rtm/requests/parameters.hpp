// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/rtm/requests/host_components.hpp"

#include <nlohmann/json.hpp>

namespace tandem::command {

/// Returns the values of the active configuration sets. `components`: a list of {pid, component}. Returns {values: a
/// list of {pid, component, values: {NAME: TEXT}}, errors: [one line each]}. A component that does not answer does not
/// affect the others.
nlohmann::json read_parameters(HostComponents& components, const nlohmann::json& request);

/// Sets `values` {NAME: TEXT} of `component` in the host `pid` like `tandem rtm conf`. Throws std::runtime_error with
/// one line.
void set_parameters(HostComponents& components, const nlohmann::json& request);

} // namespace tandem::command
