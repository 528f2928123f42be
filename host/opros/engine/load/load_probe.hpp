// SPDX-License-Identifier: Apache-2.0
// What the child process of a probe does with a component library (host/plugin/probe.hpp).
#pragma once

#include "host/plugin/probe_child.hpp"

namespace tandem::engine {

/// The name of the task, for plugin::run_probe() and plugin::serve_probe().
constexpr char load_probe_task[] = "load-opros";

/// [main-thread of the child] Loads the library, creates a component, releases it and unloads the library, and
/// reports before each step which function runs next. No callback of the component's life cycle is called.
void run_load_probe(const plugin::ProbeTask& task, plugin::ProbeReport& report);

} // namespace tandem::engine
