// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/profile/application_profile.hpp"
#include "host/opros/engine/profile/setup_error.hpp"

#include <memory>

namespace tandem::engine {

/// A port of the connection does not exist; the component may add it later.
class NoSuchPort : public SetupError {
  public:
    using SetupError::SetupError;
};

/// [one thread at a time] Connects two ports as the profile says. Both components must be initialized, because
/// components may add ports in onInitialize. Throws SetupError at the connection's line, and leaves the ports
/// unconnected, for a missing port (NoSuchPort), a wrong kind or direction, or types or method signatures that do not
/// match.
std::unique_ptr<Connection> make_connection(const ConnectionProfile& connection, ComponentHost& source,
                                            ComponentHost& target);

/// [one thread at a time] Connects a port of a bridge to a port of a component without a profile: an output event port
/// to an input event port of `target`, or a required service port to a provided service port of `target`. Throws
/// std::runtime_error, one line.
std::unique_ptr<Connection> make_connection(Port& source, Port& destination, ComponentHost& target);

} // namespace tandem::engine
