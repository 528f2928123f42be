// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <rtm/RTC.h>

namespace RTC {

/// Has the object's process ended, as far as its machine tells? Each address in the reference is tried by TCP: true if one
/// refuses and none accepts. A machine that does not answer, behind a cable that is pulled, says nothing: false.
/// [any-thread; takes up to `timeout` for each address]
bool has_process_ended(CORBA::Object_ptr object, std::chrono::milliseconds timeout);

/// Is the object gone, after its call has thrown `e`? For an object on this machine each of these exceptions means so; on
/// another one a connection that breaks, or cannot be made, may mean the network alone, and has_process_ended() decides.
bool is_object_gone(const CORBA::SystemException& e, CORBA::Object_ptr object, bool is_on_another_machine);

} // namespace RTC
