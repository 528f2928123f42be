// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/plugin/probed_side.hpp"

namespace RTC {

constexpr char probe_load[] = "load-rtm";

/// The task probe_load, its argument the init function: loads the module and makes one component of each type
/// that it registers, and deletes it. None is initialized, no name server hears of it.
void try_module(const tandem::plugin::ProbeTask& task, tandem::plugin::ProbeReport& report);

} // namespace RTC
