// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/execute/worker.hpp"

#include <ProvidedServicePort.h>
#include <ServicePortConnector.h>

#include <memory>

namespace tandem::engine {

/// Calls by name and values in the caller's thread. Whatever is not OPROS_SUCCESS becomes a
/// MethodInvokeException.
std::unique_ptr<ServicePortConnector> make_direct_connector(ProvidedServicePort& provided,
                                                            ComponentHost& provider);

/// Hands the call to a worker and returns; it is made if the provider is ACTIVE by then.
std::unique_ptr<ServicePortConnector> make_queued_connector(ProvidedServicePort& provided,
                                                            ComponentHost& provider, Worker& worker);

} // namespace tandem::engine
