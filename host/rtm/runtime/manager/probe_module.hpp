// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/plugin/probe.hpp"
#include "host/plugin/probed_side.hpp"
#include <rtm/SystemLogger.h>

namespace RTC {

constexpr char module_probe_task[] = "load-rtm";

/// Tries the module in a child process. A destructor that does not return is a warning; throws
/// tandem::plugin::Error for all else that goes wrong. [any-thread]
void probe_module(const tandem::plugin::Probe& how, const std::string& library, const std::string& init,
                  Logger& rtclog);

/// The task module_probe_task, its arguments the init function and the milliseconds for a destructor: loads the
/// module and makes one component of each type that it registers, and deletes it. None is initialized, no
/// name server hears of it.
void run_module_probe(const tandem::plugin::ProbeTask& task, tandem::plugin::ProbeReport& report);

} // namespace RTC
