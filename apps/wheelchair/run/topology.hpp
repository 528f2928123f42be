// SPDX-License-Identifier: Apache-2.0
// Who is connected to whom in the wheelchair, as data; run_directory.cpp writes it in the words of each
// model.
#pragma once

#include <string>
#include <vector>

#include "apps/wheelchair/options.hpp"

namespace tandem::wheelchair {

/// One of the three components as a run sets it up.
struct RunComponent {
    std::string name;
    double phase_ms; // place in the 10 ms grid, real time: hardware, then joystick, then control in one chain
    int priority;    // real-time, where permitted; the same as in the OPRoS component profiles
};

/// A connection; for data the sender first, for services the one who calls.
struct Connection {
    enum Kind { data, service } kind;
    std::string from, from_port, to, to_port;
};

/// In the order in which they have to start: a service's provider before those who call it.
std::vector<RunComponent> opros_components(Configuration configuration);
std::vector<RunComponent> rtm_components(Configuration configuration);
std::vector<Connection> opros_connections(Configuration configuration);
std::vector<Connection> rtm_connections(Configuration configuration);

/// One link between the hosts: AdaptorComp's name among the OPRoS components, and the RTC it stands for.
struct Bridge {
    std::string adaptor, rtc;
    std::string link_suffix; // after the run's link name
};
std::vector<Bridge> bridges(Configuration configuration);

} // namespace tandem::wheelchair
