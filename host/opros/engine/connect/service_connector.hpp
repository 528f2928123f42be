// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/execute/component_host.hpp"

#include <ProvidedServicePort.h>
#include <ServicePortConnector.h>

#include <memory>

namespace tandem::engine {

/// Each of the two functions makes the object that a required method calls if it is not bound to a provided method
/// directly. The port and the provider must outlive the result.

/// Calls the provided port by the method's name, in the caller's thread. Throws MethodInvokeException, from
/// requestService(), when the port returns anything but OPROS_SUCCESS.
std::unique_ptr<ServicePortConnector> make_direct_connector(ProvidedServicePort& provided,
                                                            ComponentHost& provider);

/// Passes each call to the provider's task queue, which it starts, and returns. The queue makes the call if the
/// provider is ACTIVE at that time, and drops the result. Throws MethodInvokeException, from requestService(), if the
/// queue is full.
std::unique_ptr<ServicePortConnector> make_queued_connector(ProvidedServicePort& provided,
                                                            ComponentHost& provider);

} // namespace tandem::engine
