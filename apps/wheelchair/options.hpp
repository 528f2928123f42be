// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tandem::wheelchair {

/// The hosts of the three components. opros, rtm: all in that host. mixed: JoystickComp is an RTC, ControlComp and
/// HWComp are OPRoS components; swapped: the opposite. split: ControlComp is an RTC, the others are OPRoS components,
/// so that the whole control loop crosses the link. memory: in this process, without hosts and ports; in lock-step,
/// every other configuration must reproduce its rows.
enum class Configuration { opros, rtm, mixed, swapped, split, memory };

std::string name_of(Configuration configuration);

/// The command line. Paths are absolute.
struct Options {
    Configuration configuration = Configuration::mixed;
    std::string scenario;      // empty: step20, or the recording of --joystick
    std::string joystick_file; // empty: the stick of the scenario
    bool drive = false;        // a person moves the stick
    std::string drive_socket;  // with drive: path of the socket for stick positions
    bool lockstep = false;
    bool compare = false;
    bool restart = false;
    double duration = 0.0; // [s]; 0: the scenario's length
    double host_wait =
        10.0; // [s]; limit for a host to become ready, and for the two ends of a link to connect
    std::string csv, plot, json;
    std::string record;                      // with lockstep: recording of the links
    std::string keep;                        // run folder to keep; empty: a temporary folder
    std::vector<std::string> host_arguments; // passed to both hosts
    int opros_cpu = -1, rtm_cpu = -1;
    double poll_us = 3000.0; // ControlComp's parameter of this name
};

/// Parses the command line. Ends the program after printing help, the version, or one line about an invalid option.
Options parse_options(int argc, char** argv);

} // namespace tandem::wheelchair
