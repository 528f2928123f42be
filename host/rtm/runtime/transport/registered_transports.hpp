// SPDX-License-Identifier: Apache-2.0
// Interface types that component libraries have registered in the factories of InPortConsumer,
// InPortProvider, OutPortConsumer and OutPortProvider.
#pragma once
#include "host/rtm/runtime/transport/remote_endpoints.hpp"
#include <rtm/ConnectorListener.h>
#include <rtm/InPortProvider.h>
#include <rtm/OutPortProvider.h>

namespace RTC {

/// The registered type that a connection's properties ask for; empty when they ask for one of ours.
std::string registered_push_type(const coil::Properties& connector_properties);
std::string registered_pull_type(const coil::Properties& connector_properties);
/// What a port of this kind says of itself beyond our own types.
void append_registered_types(SDOPackage::NVList& port_properties, bool in_port);

/// The ends that find their peer in the profile; NULL: it is not there.
std::unique_ptr<RemoteReceiver>
create_registered_receiver(const std::string& type, const ConnectorProfile& profile, coil::Properties prop);
std::unique_ptr<RemoteSender>
create_registered_sender(const std::string& type, const ConnectorProfile& profile, const ConnectorInfo& info,
                         ConnectorListenersBase& listeners, CdrBufferBase& buffer, coil::Properties prop);

/// The ends that publish themselves. They go with the connector that holds them.
using RegisteredInPortProvider = std::unique_ptr<InPortProvider, void (*)(InPortProvider*)>;
using RegisteredOutPortProvider = std::unique_ptr<OutPortProvider, void (*)(OutPortProvider*)>;
RegisteredInPortProvider create_registered_in_provider(const std::string& type, coil::Properties prop);
RegisteredOutPortProvider create_registered_out_provider(const std::string& type, coil::Properties prop);

} // namespace RTC
