// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tandem::wheelchair {

/// Where the three components run. opros, rtm: all in that host. mixed: JoystickComp is an RTC, ControlComp
/// and HWComp are OPRoS components; swapped: the other way round. split: ControlComp is an RTC, the
/// others are OPRoS components, so that the whole control loop crosses the link. memory: in this process, without hosts and
/// ports; gives the rows that every other configuration must reproduce in lock-step.
enum class Configuration { opros, rtm, mixed, swapped, split, memory };

std::string name_of(Configuration configuration);

/// The command line. Paths are absolute.
struct Options {
    Configuration configuration = Configuration::mixed;
    std::string scenario;      // empty: step20, or what --joystick records
    std::string joystick_file; // empty: the scenario's own stick
    bool drive = false;        // a person moves the stick
    std::string drive_socket;  // with drive: path of the socket that takes stick positions
    bool lockstep = false;
    bool compare = false;
    bool restart = false;
    double duration = 0.0; // [s]; 0: as long as the scenario
    double host_wait =
        10.0; // [s] for a host to become ready, and for the two ends of a link to find each other
    std::string csv, plot, json;
    std::string record;                      // with lockstep: file for a recording of the links
    std::string keep;                        // run folder to keep; empty: a temporary one that is removed
    std::vector<std::string> host_arguments; // passed to both hosts
    int opros_cpu = -1, rtm_cpu = -1;
    double poll_us = 3000.0; // ControlComp's parameter of this name
};

/// Parses the command line. Prints help, the version or one line about a wrong option, and ends the program
/// then.
Options parse_options(int argc, char** argv);

} // namespace tandem::wheelchair
