// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace omni {
class giopConnection;
}

namespace RTC {

/// Returns the socket of a connection, or -1 if it has none.
int socket_of(omni::giopConnection& connection);

} // namespace RTC
