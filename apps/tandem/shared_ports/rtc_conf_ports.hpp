// SPDX-License-Identifier: Apache-2.0
// What an RTM host would share if it were started with an rtc.conf. Components are created and initialized in a child
// process of `tandem`, connected with nothing and never activated; no name is bound and no link is opened.
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
        plugin_dirs;       ///< searched after manager.modules.load_path, before the default ones
    double timeout_s = 10; ///< time limit for the code of all components
};

/// The ports of each link that an InterceptorComp of this rtc.conf names, by the link's name. Relative names in the file
/// are relative to its folder. Throws plugin::Error with one line: what rtm_host would say, or where it crashed or hung.
std::map<std::string, link::PortTable> probe_rtc_conf(const std::filesystem::path& conf,
                                                      const RtcConfOptions& options);

/// An RTC that the rtc.conf creates, InterceptorComps excepted.
struct RtcInstance {
    std::string name;
    std::chrono::nanoseconds period; ///< of its own execution context; 0 without one
};
/// In their order of creation. Throws as probe_rtc_conf().
std::vector<RtcInstance> probe_rtc_instances(const std::filesystem::path& conf,
                                             const RtcConfOptions& options);

/// A component type that a module registers.
struct RtcType {
    std::string name, category;
};
/// Loads the module in a child process. Throws plugin::Error.
std::vector<RtcType> probe_rtc_types(const std::filesystem::path& module, const RtcConfOptions& options);

/// What a child process of this program does for these functions.
plugin::ProbeTasks rtc_probe_tasks();

} // namespace tandem::command
