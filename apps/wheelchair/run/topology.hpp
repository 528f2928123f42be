// SPDX-License-Identifier: Apache-2.0
// The components of each host in a configuration, and the connections of their ports. This is only data;
// run_directory.cpp writes it in the file formats of the two component models.
#pragma once

#include <string>
#include <vector>

#include "apps/wheelchair/options.hpp"

namespace tandem::wheelchair {

/// A component and its settings for a run.
struct RunComponent {
    std::string name;
    double phase_ms; // offset of its ticks on the common 10 ms grid, in real time
    int priority;    // of its thread, where permitted; equal to the OPRoS component profiles
};

/// A connection between two ports. `from`: sender of data, or caller of a service.
struct Connection {
    enum Kind { data, service } kind;
    std::string from, from_port, to, to_port;
};

/// Return the components of each host in start order: providers of services before their callers.
std::vector<RunComponent> opros_components(Configuration configuration);
std::vector<RunComponent> rtm_components(Configuration configuration);
/// Return the connections within each host.
std::vector<Connection> opros_connections(Configuration configuration);
std::vector<Connection> rtm_connections(Configuration configuration);

/// A link between the hosts: the instance name of its AdaptorComp in opros_host, and the RTC in rtm_host whose ports
/// the AdaptorComp mirrors.
struct Bridge {
    std::string adaptor, rtc;
    std::string link_suffix; // appended to the run's link name
};

/// Returns none unless the configuration has both hosts.
std::vector<Bridge> bridges(Configuration configuration);

} // namespace tandem::wheelchair
