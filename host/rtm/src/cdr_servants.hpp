// SPDX-License-Identifier: Apache-2.0
// The remote ends of data connectors: interface type corba_cdr.
#pragma once
#include "inlet.hpp"
#include "outlet.hpp"
#include <memory>
#include <rtm/idl/DataPort_OpenRTMSkel.h>

namespace RTC {

/// Lets peers in other processes put messages into an inlet.
class InPortCdrServant : public POA_OpenRTM::InPortCdr {
  public:
    InPortCdrServant(std::shared_ptr<DataInlet> inlet, bool little_endian)
        : inlet_(std::move(inlet)), little_endian_(little_endian) {}
    OpenRTM::PortStatus put(const OpenRTM::CdrData& data) override;

  private:
    std::shared_ptr<DataInlet> inlet_;
    bool little_endian_;
};

/// Lets peers in other processes fetch messages from an outlet.
class OutPortCdrServant : public POA_OpenRTM::OutPortCdr {
  public:
    explicit OutPortCdrServant(std::shared_ptr<DataOutlet> outlet) : outlet_(std::move(outlet)) {}
    OpenRTM::PortStatus get(OpenRTM::CdrData_out data) override;

  private:
    std::shared_ptr<DataOutlet> outlet_;
};

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

OpenRTM::PortStatus to_wire(DataPortStatus status);
DataPortStatus from_wire(OpenRTM::PortStatus status);

} // namespace RTC
