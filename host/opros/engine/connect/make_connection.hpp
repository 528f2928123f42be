// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/execute/worker_pool.hpp"

#include <memory>

namespace tandem::engine {

/// Makes one connection of the application. Throws SetupError: unknown port, wrong direction, types that do
/// not fit.
std::unique_ptr<Connection> make_connection(const ConnectionProfile& connection, ComponentHost& source,
                                            ComponentHost& target, WorkerPool& workers);

} // namespace tandem::engine
