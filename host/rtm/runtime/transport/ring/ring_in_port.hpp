// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/push_receiver.hpp"
#include <memory>
#include <rtm/RTC.h>

namespace RTC {

/// The key under which an InPort publishes its RingInPort, see publish_object().
inline constexpr char ring_in_port_key[] = "dataport.ring_inport";

/// Can the InPort of a connection with these connector_properties() take messages when it is looked at, such that neither side sees
/// a difference? Not if the sender is to be told of a full buffer, or if something else than the port waits for the message.
bool can_take_from_ring(const coil::Properties& connector_properties);

/// A servant by which a sender of this machine has `receiver` read a ring. `little_endian`: the byte order agreed for the connection.
PortableServer::ServantBase* create_ring_servant(std::shared_ptr<PushReceiver> receiver, bool little_endian);

} // namespace RTC
