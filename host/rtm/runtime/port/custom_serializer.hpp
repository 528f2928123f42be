// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/RTC.h>

namespace RTC {

/// Does a port of the connection use another serializer than CDR, named by the connection's property
/// `marshaling_type` or by the port's own configuration? Such a serializer may convert between data types, so
/// that ports of different types may be connected. Asks every port for its profile: throws
/// CORBA::SystemException when one cannot be reached.
bool uses_custom_serializer(const ConnectorProfile& profile);

} // namespace RTC
