// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/cdr_servants.hpp"
#include "host/rtm/runtime/transport/shared_memory/shared_memory_endpoints.hpp"
#include "host/rtm/runtime/upcall/servant_owners.hpp"
#include <rtm/Manager.h>

namespace RTC {

namespace {

OpenRTM::PortStatus receive_message(PushReceiver& receiver, bool little_endian,
                                    const _CORBA_Unbounded_Sequence_Octet& data) {
    ByteData bytes = received_message(data, little_endian);
    return to_port_status(receiver.receive_by_call(bytes));
}

// `data` is the out argument of an IDL operation. CORBA's C++ mapping requires a new sequence in any case, even without
// a message.
template <class Data>
OpenRTM::PortStatus fetch_message(PullBuffer& buffer, Data*& data) {
    ByteData bytes;
    const DataPortStatus status = buffer.fetch(bytes);
    const auto length = static_cast<CORBA::ULong>(bytes.getDataLength());
    data = new Data;
    data->length(length);
    bytes.readData(data->get_buffer(), length);
    return to_port_status(status);
}

/// corba_cdr, push. [ORB thread]
class InPortCdrServant : public POA_OpenRTM::InPortCdr {
  public:
    InPortCdrServant(std::shared_ptr<PushReceiver> receiver, bool little_endian)
        : receiver_(std::move(receiver)), little_endian_(little_endian) {}
    OpenRTM::PortStatus put(const OpenRTM::CdrData& data) override {
        return receive_message(*receiver_, little_endian_, data);
    }

  private:
    std::shared_ptr<PushReceiver> receiver_;
    bool little_endian_;
};

/// data_service, push. Its PortStatus has the same values as that of corba_cdr. [ORB thread]
class DataPushServant : public POA_RTC::DataPushService {
  public:
    DataPushServant(std::shared_ptr<PushReceiver> receiver, bool little_endian)
        : receiver_(std::move(receiver)), little_endian_(little_endian) {}
    RTC::PortStatus push(const RTC::OctetSeq& data) override {
        return static_cast<RTC::PortStatus>(receive_message(*receiver_, little_endian_, data));
    }

  private:
    std::shared_ptr<PushReceiver> receiver_;
    bool little_endian_;
};

/// corba_cdr, pull. [ORB thread]
class OutPortCdrServant : public POA_OpenRTM::OutPortCdr {
  public:
    explicit OutPortCdrServant(std::shared_ptr<PullBuffer> buffer) : buffer_(std::move(buffer)) {}
    OpenRTM::PortStatus get(OpenRTM::CdrData_out data) override {
        return fetch_message(*buffer_, data.ptr());
    }

  private:
    std::shared_ptr<PullBuffer> buffer_;
};

/// data_service, pull. [ORB thread]
class DataPullServant : public POA_RTC::DataPullService {
  public:
    explicit DataPullServant(std::shared_ptr<PullBuffer> buffer) : buffer_(std::move(buffer)) {}
    RTC::PortStatus pull(RTC::OctetSeq_out data) override {
        return static_cast<RTC::PortStatus>(fetch_message(*buffer_, data.ptr()));
    }

  private:
    std::shared_ptr<PullBuffer> buffer_;
};

} // namespace

ByteData received_message(const _CORBA_Unbounded_Sequence_Octet& octets, bool little_endian) {
    ByteData bytes;
    bytes.isLittleEndian(little_endian);
    bytes.writeData(octets.get_buffer(), octets.length());
    return bytes;
}

PortableServer::ServantBase* create_servant(const std::string& interface_type,
                                            std::shared_ptr<PushReceiver> receiver, bool little_endian) {
    if (interface_type == "shared_memory")
        return create_shared_memory_servant(std::move(receiver), little_endian);
    if (interface_type == "data_service") return new DataPushServant(std::move(receiver), little_endian);
    return new InPortCdrServant(std::move(receiver), little_endian);
}

PortableServer::ServantBase* create_servant(const std::string& interface_type,
                                            std::shared_ptr<PullBuffer> buffer) {
    if (interface_type == "shared_memory") return create_shared_memory_servant(std::move(buffer));
    if (interface_type == "data_service") return new DataPullServant(std::move(buffer));
    return new OutPortCdrServant(std::move(buffer));
}

ServantHolder::ServantHolder(PortableServer::ServantBase* servant, const PortBase* port)
    : poa_(Manager::instance().getPOA()), servant_(servant) {
    // From activate_object() on, the POA holds another reference.
    PortableServer::ServantBase_var owned(servant);
    if (port != nullptr) set_servant_owner(servant, find_servant_owner(port));
    id_ = poa_->activate_object(servant);
    reference_ = poa_->id_to_reference(id_.in());
}

ServantHolder::~ServantHolder() {
    set_servant_owner(servant_, nullptr);
    try {
        poa_->deactivate_object(id_.in());
    } catch (const CORBA::Exception&) {
        // The ORB was shut down first: nothing is left to deactivate.
    }
}

std::string ServantHolder::ior() const {
    CORBA::String_var text = Manager::instance().theORB()->object_to_string(reference_.in());
    return text.in();
}

OpenRTM::PortStatus to_port_status(DataPortStatus status) {
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

DataPortStatus from_port_status(OpenRTM::PortStatus status) {
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
