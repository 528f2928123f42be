// SPDX-License-Identifier: Apache-2.0
#include "cdr_servants.hpp"
#include <rtm/Manager.h>

namespace RTC {

OpenRTM::PortStatus InPortCdrServant::put(const OpenRTM::CdrData& data) {
    ByteData bytes;
    bytes.isLittleEndian(little_endian_);
    bytes.writeData(data.get_buffer(), data.length());
    return to_wire(inlet_->receive(bytes));
}

OpenRTM::PortStatus OutPortCdrServant::get(OpenRTM::CdrData_out data) {
    ByteData bytes;
    const DataPortStatus status = outlet_->fetch(bytes);
    data = new OpenRTM::CdrData;
    data->length(static_cast<CORBA::ULong>(bytes.getDataLength()));
    bytes.readData(data->get_buffer(), bytes.getDataLength());
    return to_wire(status);
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
