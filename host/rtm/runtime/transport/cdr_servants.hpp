// SPDX-License-Identifier: Apache-2.0
// The ends of data connectors that peers in other processes call: corba_cdr and data_service.
#pragma once
#include "host/rtm/runtime/transport/pull_buffer.hpp"
#include "host/rtm/runtime/transport/push_receiver.hpp"
#include <memory>
#include <rtm/idl/DataPortSkel.h>
#include <rtm/idl/DataPort_OpenRTMSkel.h>

namespace RTC {

/// What lets peers in other processes put messages into an receiver, or fetch them from an buffer.
/// `interface_type`: corba_cdr or data_service.
PortableServer::ServantBase* create_servant(const std::string& interface_type,
                                            std::shared_ptr<PushReceiver> receiver, bool little_endian);
PortableServer::ServantBase* create_servant(const std::string& interface_type,
                                            std::shared_ptr<PullBuffer> buffer);

/// Activates a servant in the root POA for as long as it lives; the servant is deleted with its last call.
class ServantHolder {
  public:
    explicit ServantHolder(PortableServer::ServantBase* servant);
    ~ServantHolder();
    ServantHolder(const ServantHolder&) = delete;
    ServantHolder& operator=(const ServantHolder&) = delete;
    CORBA::Object_ptr reference() const { return reference_.in(); }
    std::string ior() const;

  private:
    PortableServer::POA_var poa_;
    PortableServer::ObjectId_var id_;
    CORBA::Object_var reference_;
};

OpenRTM::PortStatus to_port_status(DataPortStatus status);
DataPortStatus from_port_status(OpenRTM::PortStatus status);

} // namespace RTC
