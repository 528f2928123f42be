// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/plugin/probe.hpp"
#include <chrono>
#include <filesystem>
#include <optional>
#include <rtm/Manager.h>
#include <vector>

namespace RTC {

/// What our host decides and rtc.conf cannot.
struct HostOptions {
    bool lockstep = false; ///< contexts have no threads; somebody calls Manager::step()
    int cpu = -1;
    std::chrono::nanoseconds tick_spin{0};
    /// How long a context waits for a callback to return when it is stopped.
    std::chrono::nanoseconds stop_timeout = std::chrono::seconds(2);
    std::vector<std::filesystem::path> plugin_path; ///< searched after manager.modules.load_path
    std::optional<tandem::plugin::Probe> probe;     ///< modules are tried in a child process first
    bool can_restart = false;                       ///< it looks at Manager::restartWanted() in the end
    bool strict = false;                            ///< rtc.conf must exist and be well-formed
};

struct Manager::Options : HostOptions {};

/// Those of the running manager; defaults when there is none.
HostOptions host_options();

} // namespace RTC
