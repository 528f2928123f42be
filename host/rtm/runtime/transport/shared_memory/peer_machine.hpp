// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/RTC.h>
#include <string>

namespace RTC {

/// Where the object's process is reached, `giop:tcp:HOST:PORT`, if none of the addresses in its reference belongs to this
/// machine; otherwise empty, also without an address. Host names are resolved. [any-thread]
std::string address_on_another_machine(CORBA::Object_ptr object);

/// Why the ports of a connection cannot share memory: one of them is on another machine. Empty if they can.
std::string shared_memory_obstacle(const ConnectorProfile& profile);

} // namespace RTC
