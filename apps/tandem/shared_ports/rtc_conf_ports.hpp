// SPDX-License-Identifier: Apache-2.0
// Finds the ports that an RTM host would share with an rtc.conf. Creates and initializes components in a child process
// of `tandem`. Does not connect or activate them, bind names, or open links.
#pragma once

#include "host/plugin/probe_child.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tandem::command {

struct RtcConfOptions {
    std::vector<std::filesystem::path>
        plugin_dirs;       ///< searched after manager.modules.load_path, before the default folders
    double timeout_s = 10; ///< time limit for the code of all components
};

/// Returns the ports of each link that an InterceptorComp of this rtc.conf names, by the link's name. Relative names in
/// the file are relative to its folder. Throws plugin::Error with one line: rtm_host's message, or where it crashed or
/// hung.
std::map<std::string, link::PortTable> probe_rtc_conf(const std::filesystem::path& conf,
                                                      const RtcConfOptions& options);

/// An RTC that the rtc.conf creates, except InterceptorComps.
struct RtcInstance {
    std::string name;
    std::chrono::nanoseconds period; ///< of the execution context that it owns; 0: it owns none
};
/// Returns the RTCs in their order of creation. Throws like probe_rtc_conf().
std::vector<RtcInstance> probe_rtc_instances(const std::filesystem::path& conf,
                                             const RtcConfOptions& options);

/// A component type that a module registers.
struct RtcType {
    std::string name, category;
};
/// Loads the module in a child process. Throws plugin::Error.
std::vector<RtcType> probe_rtc_types(const std::filesystem::path& module, const RtcConfOptions& options);

/// Returns the tasks of child processes for these functions.
plugin::ProbeTasks rtc_probe_tasks();

} // namespace tandem::command
