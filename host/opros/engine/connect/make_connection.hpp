// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/profile/application_profile.hpp"

#include <memory>

namespace tandem::engine {

/// [main-thread] Connects two ports as the profile says. Both components must be initialized, since components
/// may add ports in onInitialize. Throws SetupError at the connection's line: unknown port, wrong kind or
/// direction, or types or method signatures that do not match; the ports are then left unconnected.
std::unique_ptr<Connection> make_connection(const ConnectionProfile& connection, ComponentHost& source,
                                            ComponentHost& target);

} // namespace tandem::engine
