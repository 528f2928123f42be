// SPDX-License-Identifier: Apache-2.0
// The interface type shared_memory of OpenRTM-aist: each message is in a SharedMessage object, and one CORBA call
// announces it. Both processes must be on one machine and be permitted to read each other's objects, as processes of
// one user are.
#pragma once
#include "host/rtm/runtime/transport/pull_buffer.hpp"
#include "host/rtm/runtime/transport/push_receiver.hpp"
#include "host/rtm/runtime/transport/remote_endpoints.hpp"
#include <memory>

namespace RTC {

/// Creates the sending end of a push. `object`: the PortSharedMemory that the InPort has published.
std::unique_ptr<RemoteReceiver> create_shared_memory_receiver(CORBA::Object_ptr object);
/// Creates the receiving end of a push, which the InPort publishes.
PortableServer::ServantBase* create_shared_memory_servant(std::shared_ptr<PushReceiver> receiver,
                                                          bool little_endian);
/// Creates the receiving end of a pull. `object`: the PortSharedMemory that the OutPort has published.
std::unique_ptr<RemoteSender> create_shared_memory_sender(CORBA::Object_ptr object);
/// Creates the sending end of a pull, which the OutPort publishes.
PortableServer::ServantBase* create_shared_memory_servant(std::shared_ptr<PullBuffer> buffer);

} // namespace RTC
