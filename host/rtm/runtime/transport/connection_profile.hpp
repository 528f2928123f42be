// SPDX-License-Identifier: Apache-2.0
// Reads and writes the profile of a connection, for data ports and their connectors. The keys are
// those of OpenRTM-aist. All functions [any-thread].
#pragma once
#include <rtm/ConnectorBase.h>
#include <string>

namespace RTC {

/// The properties of a connector as one side sees them: the port's own, then `dataport.*`, then
/// `dataport.<side>.*` (side: inport or outport); keys without those prefixes, the later win.
coil::Properties connector_properties(const coil::Properties& port, const ConnectorProfile& profile,
                                      const char* side);

/// Name, id, ports (as IORs) of the connection, with `properties` of connector_properties().
ConnectorInfo connector_info(const ConnectorProfile& profile, const coil::Properties& properties);

/// Returns whether the first byte order that `serializer.cdr.endian` names (`little`, `big`, or a list) is
/// little-endian. Also returns true if it names none, as in OpenRTM-aist.
bool is_little_endian(const coil::Properties& connector_properties);

/// Returns in one line why an InPort (or an OutPort) cannot make a connection with this profile and these
/// connector_properties(); empty if it can.
std::string unsupported_reason(const ConnectorProfile& profile, const coil::Properties& connector_properties,
                               bool in_port);

/// Returns the object that the other port has published as a reference under `<key>_ref` or as an IOR under
/// `<key>_ior`; nil if there is none. The caller owns the reference. Throws CORBA::SystemException if the IOR is
/// malformed.
CORBA::Object_ptr find_published_object(const ConnectorProfile& profile, const std::string& key);

/// Publishes the object in both forms: OpenRTM-aist reads one or the other, depending on its version.
void publish_object(ConnectorProfile& profile, const std::string& key, CORBA::Object_ptr object,
                    const std::string& ior);

} // namespace RTC
