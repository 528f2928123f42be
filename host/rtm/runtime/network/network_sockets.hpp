// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace RTC {

/// Sets what CORBA's connections with other machines need, of each one that is made from now on. A call that has ended without
/// an answer leaves nothing in the kernel that could arrive later, behind newer messages; and a connection whose other
/// end has vanished ends, in 2 s where a call waits for it and in half a minute otherwise. After ORB_init(), once in a process.
void set_up_network_sockets();

} // namespace RTC
