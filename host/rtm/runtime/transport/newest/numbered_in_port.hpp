// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/push_receiver.hpp"
#include <memory>
#include <rtm/RTC.h>

namespace RTC {

/// The key under which an InPort publishes its NumberedInPort, see publish_object().
inline constexpr char numbered_in_port_key[] = "dataport.corba_cdr.numbered_inport";

/// A servant that passes numbered messages to `receiver`. `little_endian`: the byte order agreed for the connection.
PortableServer::ServantBase* create_numbered_servant(std::shared_ptr<PushReceiver> receiver,
                                                     bool little_endian);

} // namespace RTC
