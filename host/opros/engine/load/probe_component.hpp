// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/plugin/probed_side.hpp"

namespace tandem::engine {

constexpr char probe_load[] = "load-opros";

/// The task probe_load: loads the library, makes a component, releases it, unloads the library. Nothing of
/// the component's life cycle is run.
void try_component(const plugin::ProbeTask& task, plugin::ProbeReport& report);

} // namespace tandem::engine
