// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/cdr_servants.hpp"
#include <rtm/Manager.h>

namespace RTC {

namespace {

OpenRTM::PortStatus take(DataInlet& inlet, bool little_endian, const _CORBA_Unbounded_Sequence_Octet& data) {
    ByteData bytes;
    bytes.isLittleEndian(little_endian);
    bytes.writeData(data.get_buffer(), data.length());
    return to_wire(inlet.receive(bytes));
}

template <class Data>
OpenRTM::PortStatus give(DataOutlet& outlet, Data*& data) {
    ByteData bytes;
    const DataPortStatus status = outlet.fetch(bytes);
    const auto length = static_cast<CORBA::ULong>(bytes.getDataLength());
    data = new Data;
    data->length(length);
    bytes.readData(data->get_buffer(), length);
    return to_wire(status);
}

class InPortCdrServant : public POA_OpenRTM::InPortCdr {
  public:
    InPortCdrServant(std::shared_ptr<DataInlet> inlet, bool little_endian)
        : inlet_(std::move(inlet)), little_endian_(little_endian) {}
    OpenRTM::PortStatus put(const OpenRTM::CdrData& data) override {
        return take(*inlet_, little_endian_, data);
    }

  private:
    std::shared_ptr<DataInlet> inlet_;
    bool little_endian_;
};

class DataPushServant : public POA_RTC::DataPushService {
  public:
    DataPushServant(std::shared_ptr<DataInlet> inlet, bool little_endian)
        : inlet_(std::move(inlet)), little_endian_(little_endian) {}
    RTC::PortStatus push(const RTC::OctetSeq& data) override {
        return static_cast<RTC::PortStatus>(take(*inlet_, little_endian_, data));
    }

  private:
    std::shared_ptr<DataInlet> inlet_;
    bool little_endian_;
};

class OutPortCdrServant : public POA_OpenRTM::OutPortCdr {
  public:
    explicit OutPortCdrServant(std::shared_ptr<DataOutlet> outlet) : outlet_(std::move(outlet)) {}
    OpenRTM::PortStatus get(OpenRTM::CdrData_out data) override { return give(*outlet_, data.ptr()); }

  private:
    std::shared_ptr<DataOutlet> outlet_;
};

class DataPullServant : public POA_RTC::DataPullService {
  public:
    explicit DataPullServant(std::shared_ptr<DataOutlet> outlet) : outlet_(std::move(outlet)) {}
    RTC::PortStatus pull(RTC::OctetSeq_out data) override {
        return static_cast<RTC::PortStatus>(give(*outlet_, data.ptr()));
    }

  private:
    std::shared_ptr<DataOutlet> outlet_;
};

} // namespace

PortableServer::ServantBase* make_servant(const std::string& interface_type, std::shared_ptr<DataInlet> inlet,
                                          bool little_endian) {
    if (interface_type == "data_service") return new DataPushServant(std::move(inlet), little_endian);
    return new InPortCdrServant(std::move(inlet), little_endian);
}

PortableServer::ServantBase* make_servant(const std::string& interface_type,
                                          std::shared_ptr<DataOutlet> outlet) {
    if (interface_type == "data_service") return new DataPullServant(std::move(outlet));
    return new OutPortCdrServant(std::move(outlet));
}

ServantHolder::ServantHolder(PortableServer::ServantBase* servant) : poa_(Manager::instance().getPOA()) {
    PortableServer::ServantBase_var owned(servant);
    id_ = poa_->activate_object(servant);
    reference_ = poa_->id_to_reference(id_.in());
}

ServantHolder::~ServantHolder() {
    try {
        poa_->deactivate_object(id_.in());
    } catch (const CORBA::Exception&) {
        // the ORB has gone down before: nothing is left to deactivate
    }
}

std::string ServantHolder::ior() const {
    CORBA::String_var text = Manager::instance().theORB()->object_to_string(reference_.in());
    return text.in();
}

OpenRTM::PortStatus to_wire(DataPortStatus status) {
    switch (status) {
    case DataPortStatus::PORT_OK:
        return OpenRTM::PORT_OK;
    case DataPortStatus::BUFFER_FULL:
        return OpenRTM::BUFFER_FULL;
    case DataPortStatus::BUFFER_EMPTY:
        return OpenRTM::BUFFER_EMPTY;
    case DataPortStatus::BUFFER_TIMEOUT:
        return OpenRTM::BUFFER_TIMEOUT;
    case DataPortStatus::PORT_ERROR:
    case DataPortStatus::CONNECTION_LOST:
        return OpenRTM::PORT_ERROR;
    default:
        return OpenRTM::UNKNOWN_ERROR;
    }
}

DataPortStatus from_wire(OpenRTM::PortStatus status) {
    switch (status) {
    case OpenRTM::PORT_OK:
        return DataPortStatus::PORT_OK;
    case OpenRTM::PORT_ERROR:
        return DataPortStatus::PORT_ERROR;
    case OpenRTM::BUFFER_FULL:
        return DataPortStatus::SEND_FULL;
    case OpenRTM::BUFFER_EMPTY:
        return DataPortStatus::RECV_EMPTY;
    case OpenRTM::BUFFER_TIMEOUT:
        return DataPortStatus::SEND_TIMEOUT;
    default:
        return DataPortStatus::UNKNOWN_ERROR;
    }
}

} // namespace RTC
