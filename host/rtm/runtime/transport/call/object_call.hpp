// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/call/call_segment.hpp"

namespace RTC {

/// Executes an operation of an object of this process as the ORB executes a request from a socket: through the object's
/// POA and its servant, which may have a compiled skeleton or none. `arguments` is positioned at the arguments. Writes the reply,
/// which is an exception if the servant throws. [any thread that the ORB knows: omni_thread::ensure_self]
void call_object(CORBA::Object_ptr object, const char* operation, CallStream& arguments, CallStream& reply);

} // namespace RTC
