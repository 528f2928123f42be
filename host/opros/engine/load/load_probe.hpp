// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/plugin/probe_child.hpp"

namespace tandem::engine {

constexpr char load_probe_task[] = "load-opros";

/// The task load_probe_task: loads the library, makes a component, releases it, unloads the library. Nothing of
/// the component's life cycle is run.
void run_load_probe(const plugin::ProbeTask& task, plugin::ProbeReport& report);

} // namespace tandem::engine
