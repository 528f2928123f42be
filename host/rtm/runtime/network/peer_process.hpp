// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <rtm/RTC.h>

namespace RTC {

/// What a process answers to a TCP connection to the addresses in the reference of its object.
enum class PeerState {
    listens, ///< an address accepts; the process may still hang
    ended,   ///< an address refuses and none accepts
    silent   ///< no answer: the network is down, or the machine is off
};
/// [any-thread; takes up to `timeout` for each address. Host names are resolved first, within the resolver's own
/// limits.]
PeerState probe_peer(CORBA::Object_ptr object, std::chrono::milliseconds timeout);

/// Returns whether the object no longer exists, after its call has thrown `e`. For an object on this machine, each of
/// these exceptions means that. For an object on another machine, a connection that breaks or cannot be made may only
/// mean a network failure, and probe_peer() decides.
bool is_object_gone(const CORBA::SystemException& e, CORBA::Object_ptr object, bool is_on_another_machine);

} // namespace RTC
