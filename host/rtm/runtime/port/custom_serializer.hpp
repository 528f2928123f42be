// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/RTC.h>

namespace RTC {

/// Returns whether a port of the connection uses another serializer than CDR, which the connection's property
/// `marshaling_type` or the port's own configuration names. Such a serializer may convert data types, so ports of
/// different types may be connected. Asks every port for its profile. Throws CORBA::SystemException if one cannot be
/// reached.
bool uses_custom_serializer(const ConnectorProfile& profile);

} // namespace RTC
