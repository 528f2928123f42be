// SPDX-License-Identifier: Apache-2.0
// The CORBA objects through which peers in other processes push messages to an InPort or pull them from an
// OutPort: corba_cdr (DataPort_OpenRTM.idl), data_service (DataPort.idl) and shared_memory.
#pragma once
#include "host/rtm/runtime/transport/pull_buffer.hpp"
#include "host/rtm/runtime/transport/push_receiver.hpp"
#include <memory>
#include <rtm/PortBase.h>
#include <rtm/idl/DataPortSkel.h>
#include <rtm/idl/DataPort_OpenRTMSkel.h>

namespace RTC {

/// Returns a message that arrived as octets. `little_endian`: its byte order. CdrData and OctetSeq of the two IDL files
/// are different types with the same base.
ByteData received_message(const _CORBA_Unbounded_Sequence_Octet& octets, bool little_endian);

/// Creates a servant that passes pushed messages to `receiver`. `interface_type` as returned by corba_interface_type().
/// `little_endian`: the byte order agreed for the connection, because the octets on the wire do not carry it.
PortableServer::ServantBase* create_servant(const std::string& interface_type,
                                            std::shared_ptr<PushReceiver> receiver, bool little_endian);
/// A servant from which a peer pulls the messages of `buffer`.
PortableServer::ServantBase* create_servant(const std::string& interface_type,
                                            std::shared_ptr<PullBuffer> buffer);

/// Keeps a servant activated in the root POA during its own lifetime. Takes over the servant, which the POA deletes
/// after its last call has ended. The calls belong to the component of `port`, unless `port` is NULL. The constructor
/// throws CORBA::SystemException.
class ServantHolder {
  public:
    explicit ServantHolder(PortableServer::ServantBase* servant, const PortBase* port = nullptr);
    ~ServantHolder();
    ServantHolder(const ServantHolder&) = delete;
    ServantHolder& operator=(const ServantHolder&) = delete;

    /// The reference is not duplicated; it is valid as long as this object.
    CORBA::Object_ptr reference() const { return reference_.in(); }
    std::string ior() const;

  private:
    PortableServer::POA_var poa_;
    const omniServant* servant_; // of the POA
    PortableServer::ObjectId_var id_;
    CORBA::Object_var reference_;
};

/// Converts the outcome of a call in this process into the answer of a servant, and an answer into the outcome for the
/// caller. The IDL has fewer codes, so to_port_status() loses some. from_port_status() returns the caller's view: the
/// peer's full buffer is SEND_FULL here, its empty buffer RECV_EMPTY.
OpenRTM::PortStatus to_port_status(DataPortStatus status);
DataPortStatus from_port_status(OpenRTM::PortStatus status);

} // namespace RTC
