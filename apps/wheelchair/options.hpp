// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tandem::wheelchair {

/// Where the three components run. memory: in this process without any host, what the others must reproduce.
/// mixed: the joystick an RTC, control and hardware OPRoS components; swapped: the other way round.
enum class Configuration { opros, rtm, mixed, swapped, memory };

std::string name_of(Configuration configuration);

struct Options {
    Configuration configuration = Configuration::mixed;
    std::string scenario;      // empty: step20, or what --joystick records
    std::string joystick_file; // absolute
    bool lockstep = false;
    bool compare = false;
    bool restart = false;
    double duration = 0.0; // s, 0: as long as the scenario
    double host_wait =
        10.0; // s a host may take to become ready, and the halves of the link to find each other
    std::string csv, plot, json;
    std::string keep; // run directory to keep; empty: a temporary one, removed afterwards
    std::vector<std::string> host_arguments; // for both hosts
    int opros_cpu = -1, rtm_cpu = -1;
    double poll_us = 3000.0;
};

/// Paths come back absolute. Prints help or one line about a wrong option and ends the program.
Options parse_options(int argc, char** argv);

} // namespace tandem::wheelchair
