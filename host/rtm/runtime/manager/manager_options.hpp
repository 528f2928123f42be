// SPDX-License-Identifier: Apache-2.0
// Settings of the hosting program. Programs in apps/ and tests include this header to start a manager.
#pragma once
#include "host/plugin/probe.hpp"
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <rtm/Manager.h>
#include <vector>

namespace RTC {

/// What the hosting program decides and rtc.conf cannot.
struct HostOptions {
    bool lockstep = false; ///< contexts have no threads; the host calls Manager::step() for each cycle
    int cpu = -1;          ///< default processor for threads of contexts; -1: any
    /// Time before a tick in which a context polls the clock; none: the default of rt::TickOptions.
    std::optional<std::chrono::nanoseconds> tick_spin;
    /// How long the stop of a context waits for the context's running callback to return.
    std::chrono::nanoseconds stop_timeout = std::chrono::seconds(2);
    /// Called before each step of the set-up in which a component's code runs, so that one that hangs can be
    /// named: `onInitialize or onStartup of component Camera0`. [any-thread]
    std::function<void(std::string step)> on_setup_step;
    std::vector<std::filesystem::path> plugin_path;    ///< searched after manager.modules.load_path
    std::optional<tandem::plugin::ProbeOptions> probe; ///< modules are loaded in a child process first
    /// The program's name, if it reports crashes (host/crash); NULL: the program's own signal handlers stay.
    const char* crash_report = nullptr;
    bool can_restart = false; ///< the program restarts when Manager::restartRequested() is true
};

struct Manager::Options : HostOptions {};

/// Returns the options of the running manager, and the defaults before it is started. [any-thread]
HostOptions host_options();

/// Returns what did not return when the manager was shut down, for example `onExecute of Camera0, its destructor of
/// Arm0`. Empty if everything ended cleanly. [any-thread]
std::string left_behind(Manager& manager);

/// Ends the manager in the calling thread, even during its set-up, for a program whose set-up hangs. Returns the result of
/// Manager::shutdown(), which would wait for the set-up. [any-thread]
bool end_during_set_up(Manager& manager);

} // namespace RTC
