// SPDX-License-Identifier: Apache-2.0
// Transports (interface types) that component libraries have registered in the factories of InPortConsumer,
// InPortProvider, OutPortConsumer and OutPortProvider. A provider publishes its address in the profile of a
// connection; the consumer at the other port finds it there. A library may bring either or both.
#pragma once
#include "host/rtm/runtime/transport/remote_endpoints.hpp"
#include <rtm/ConnectorListener.h>
#include <rtm/InPortProvider.h>
#include <rtm/OutPortProvider.h>

namespace RTC {

/// Returns the registered interface type that a push (or pull) connection requests with `interface_type`. Empty if it
/// requests one of Tandem's types or an unregistered type.
std::string registered_push_type(const coil::Properties& connector_properties);
std::string registered_pull_type(const coil::Properties& connector_properties);

/// Adds the registered types to `dataport.interface_type` in the profile of an InPort or an OutPort, for tools to
/// offer.
void append_registered_types(SDOPackage::NVList& port_properties, bool in_port);

/// Creates the consumer of that type as the sending end of a push (or the receiving end of a pull) connection. Returns
/// NULL if there is no such consumer, or if it does not find its provider's address in the profile.
std::unique_ptr<RemoteReceiver>
create_registered_receiver(const std::string& type, const ConnectorProfile& profile, coil::Properties prop);
std::unique_ptr<RemoteSender>
create_registered_sender(const std::string& type, const ConnectorProfile& profile, const ConnectorInfo& info,
                         ConnectorListenersBase& listeners, CdrBufferBase& buffer, coil::Properties prop);

/// Creates a provider of that type. Its factory takes it back when the connector that holds it is deleted. Returns NULL
/// if there is none.
using RegisteredInPortProvider = std::unique_ptr<InPortProvider, void (*)(InPortProvider*)>;
using RegisteredOutPortProvider = std::unique_ptr<OutPortProvider, void (*)(OutPortProvider*)>;
RegisteredInPortProvider create_registered_in_provider(const std::string& type, coil::Properties prop);
RegisteredOutPortProvider create_registered_out_provider(const std::string& type, coil::Properties prop);

} // namespace RTC
