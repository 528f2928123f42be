// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/RTC.h>
#include <string>

namespace RTC {

/// Returns whether the address, as omniORB writes it (`giop:tcp:127.0.0.1:4711`), belongs to this machine. A Unix socket does
/// if it exists here. Host names are resolved, within the resolver's own time limits. [any-thread]
bool is_address_of_this_machine(const std::string& giop_address);

/// Where the object's process is reached, `giop:tcp:HOST:PORT`, if none of the addresses in its reference belongs to this
/// machine; otherwise empty, also without an address. Host names are resolved, within the resolver's own
/// time limits. [any-thread]
std::string address_on_another_machine(CORBA::Object_ptr object);

} // namespace RTC
