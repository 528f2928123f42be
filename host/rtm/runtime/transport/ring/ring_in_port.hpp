// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/push_receiver.hpp"
#include <memory>
#include <rtm/RTC.h>

namespace RTC {

/// The key under which an InPort publishes its RingInPort, see publish_object().
inline constexpr char ring_in_port_key[] = "dataport.ring_inport";

/// Returns whether the InPort of a connection with these connector_properties() can take messages when it is looked at,
/// without a visible difference for either side. Returns false if the sender must learn of a full buffer, or if
/// something other than the port waits for the message.
bool can_receive_from_ring(const coil::Properties& connector_properties);

/// Creates a servant by which a sender of this machine makes `receiver` read a ring. `little_endian`: the byte order
/// agreed for the connection.
PortableServer::ServantBase* create_ring_servant(std::shared_ptr<PushReceiver> receiver, bool little_endian);

} // namespace RTC
