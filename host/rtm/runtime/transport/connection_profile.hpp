// SPDX-License-Identifier: Apache-2.0
// What both kinds of data ports do with connection profiles.
#pragma once
#include <rtm/ConnectorBase.h>
#include <string>

namespace RTC {

/// The properties of a connector as one side sees them: the port's own, then `dataport.*`, then
/// `dataport.<side>.*` (side: inport or outport); keys without those prefixes.
coil::Properties connector_properties(const coil::Properties& port, const ConnectorProfile& profile,
                                      const char* side);

/// Does a port of the connection use a serializer of somebody's own, named by the connection or by the port's
/// own configuration? Such a one may make another type of a value. Asks the ports: throws
/// CORBA::SystemException.
bool converts(const ConnectorProfile& profile);

ConnectorInfo connector_info(const ConnectorProfile& profile, const coil::Properties& properties);

/// The first byte order that `serializer.cdr.endian` names (little, big; a list); little when it names none.
bool is_little_endian(const coil::Properties& connector_properties);
/// Why a connection with these properties cannot be made; empty when it can.
std::string unsupported(const coil::Properties& connector_properties);

/// A reference published as an object or as an IOR under `<key>_ref` and `<key>_ior`; nil when there is none.
CORBA::Object_ptr published_object(const ConnectorProfile& profile, const std::string& key);
void publish_object(ConnectorProfile& profile, const std::string& key, CORBA::Object_ptr object,
                    const std::string& ior);

} // namespace RTC
