// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/shared_memory/obstacle.hpp"
#include "host/rtm/runtime/network/peer_machine.hpp"

namespace RTC {

std::string shared_memory_obstacle(const ConnectorProfile& profile) {
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
        const std::string address = address_on_another_machine(profile.ports[i]);
        if (!address.empty())
            return "interface_type is shared_memory, for ports of one machine, but a port of the connection "
                   "is at " +
                   address + "; use corba_cdr";
    }
    return "";
}

} // namespace RTC
