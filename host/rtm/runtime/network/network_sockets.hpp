// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace RTC {

/// Sets what CORBA's connections with other machines need, of each one that is made from now on. A call that has ended without
/// an answer leaves nothing in the kernel that could arrive later, behind newer messages; and a connection whose other
/// end has vanished ends, in 2 s where a call waits for it and in half a minute otherwise. After ORB_init(), once in a process.
void set_up_network_sockets();

/// Has children that this process fork()s close the sockets of the ORB, those at which it listens and the connections that it has
/// accepted. Otherwise a child that outlives the process keeps its port, and the peers see no end of their connections.
class OrbSocketsAtFork {
  public:
    OrbSocketsAtFork(); ///< Before the ORB listens.
    void set_up();      ///< Once it does. Again for each further ORB of the process.

  private:
    std::vector<std::string> places_before_;
};

} // namespace RTC
