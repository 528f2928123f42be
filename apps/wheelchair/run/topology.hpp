// SPDX-License-Identifier: Apache-2.0
// Which components each host runs in a configuration, and how their ports are connected. Data only:
// run_directory.cpp writes it in the file formats of the two component models.
#pragma once

#include <string>
#include <vector>

#include "apps/wheelchair/options.hpp"

namespace tandem::wheelchair {

/// A component as a run sets it up.
struct RunComponent {
    std::string name;
    double phase_ms; // offset of its ticks on the common 10 ms grid, in real time
    int priority;    // of its thread, where permitted; the OPRoS component profiles have the same
};

/// A connection between two ports. `from` is the sender of data, or the caller of a service.
struct Connection {
    enum Kind { data, service } kind;
    std::string from, from_port, to, to_port;
};

/// The components of each host, in start order: the provider of a service before its callers.
std::vector<RunComponent> opros_components(Configuration configuration);
std::vector<RunComponent> rtm_components(Configuration configuration);
/// The connections within each host.
std::vector<Connection> opros_connections(Configuration configuration);
std::vector<Connection> rtm_connections(Configuration configuration);

/// A link between the hosts: the instance name of its AdaptorComp in opros_host, and the RTC in rtm_host
/// whose ports that AdaptorComp mirrors.
struct Bridge {
    std::string adaptor, rtc;
    std::string link_suffix; // appended to the run's link name
};

/// Empty unless the configuration has both hosts.
std::vector<Bridge> bridges(Configuration configuration);

} // namespace tandem::wheelchair
