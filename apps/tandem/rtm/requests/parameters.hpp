// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/rtm/requests/host_components.hpp"

#include <nlohmann/json.hpp>

namespace tandem::command {

/// The values of the active configuration sets. `components`: a list of {pid, component}. Returns {values: a list of {pid, component,
/// values: {NAME: TEXT}}, errors: [one line each]}; one that does not answer keeps none of the others from being read.
nlohmann::json read_parameters(HostComponents& components, const nlohmann::json& request);

/// Sets `values` {NAME: TEXT} of `component` in the host `pid`, as `tandem rtm conf` does. Throws std::runtime_error, one line.
void set_parameters(HostComponents& components, const nlohmann::json& request);

} // namespace tandem::command
