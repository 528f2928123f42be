// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/link.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/execute/worker_pool.hpp"

#include <memory>

namespace tandem::engine {

/// Makes one connection of the application. Throws SetupError: unknown port, wrong direction, types that do
/// not fit.
std::unique_ptr<Link> connect(const Connection& connection, ComponentHost& source, ComponentHost& target,
                              WorkerPool& workers);

} // namespace tandem::engine
