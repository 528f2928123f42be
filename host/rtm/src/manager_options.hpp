// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <filesystem>
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
    bool strict = false;                            ///< rtc.conf must exist and be well-formed
};

struct Manager::Options : HostOptions {};

/// Those of the running manager; defaults when there is none.
HostOptions host_options();

} // namespace RTC
