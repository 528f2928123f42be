// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <omniORB4/CORBA.h>

namespace RTC {

class CallSender;

/// Returns whether the object is in another process, as far as the ORB knows. [any-thread]
bool is_in_another_process(CORBA::Object_ptr object);

/// Makes calls through this reference, and through references that are narrowed from it, use shared memory where possible.
/// All other uses of the reference go through the ORB. The object is in another process. [any-thread]
void send_calls(CORBA::Object_ptr object, std::shared_ptr<CallSender> sender);

} // namespace RTC
