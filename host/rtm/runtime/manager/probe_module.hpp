// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/plugin/probe.hpp"
#include "host/plugin/probe_child.hpp"
#include <rtm/SystemLogger.h>

namespace RTC {

/// Name of the probe task that run_module_probe() carries out (host/plugin/probe.hpp).
constexpr char module_probe_task[] = "load-rtm";

/// In the host: loads the module in a child process with run_module_probe(). Logs a warning for a destructor
/// that does not return; throws tandem::plugin::Error for a crash, a hang or any other failure. [any-thread]
void probe_module(const tandem::plugin::ProbeOptions& options, const std::string& library,
                  const std::string& init, Logger& rtclog);

/// In the child process: loads the module, creates and deletes one component of each type that it registers,
/// without initializing it. Arguments of the task: the init function, and the milliseconds that a destructor
/// may take. Throws ManagerError or tandem::plugin::Error; reports the type whose destructor hangs.
void run_module_probe(const tandem::plugin::ProbeTask& task, tandem::plugin::ProbeReport& report);

} // namespace RTC
