// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace RTC {

/// Configures each future CORBA connection with another machine. A call that has ended without an answer then leaves no
/// data in the kernel that could arrive later, after newer messages. A connection whose other end has vanished ends:
/// within 2 s if a call waits for it, otherwise within half a minute. Call it once in a process, after ORB_init().
void set_up_network_sockets();

/// Makes the children that this process fork()s close the ORB's sockets: the listening ones and the accepted
/// connections. Otherwise a child that outlives the process keeps its port, and the peers see no end of their
/// connections.
class OrbSocketsAtFork {
  public:
    OrbSocketsAtFork(); ///< Before the ORB listens.
    void set_up();      ///< Call it once the ORB listens, and again for each further ORB of the process.

  private:
    std::vector<std::string> places_before_;
};

} // namespace RTC
