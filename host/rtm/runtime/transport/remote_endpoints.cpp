// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/remote_endpoints.hpp"
#include "host/rtm/runtime/network/peer_machine.hpp"
#include "host/rtm/runtime/network/peer_process.hpp"
#include "host/rtm/runtime/transport/cdr_servants.hpp"
#include "host/rtm/runtime/transport/connection_profile.hpp"
#include "host/rtm/runtime/transport/peer_answers.hpp"
#include "host/rtm/runtime/transport/shared_memory/shared_memory_endpoints.hpp"

namespace RTC {

// omniORB throws TRANSIENT and COMM_FAILURE if the process no longer exists, and OBJECT_NOT_EXIST, OBJ_ADAPTER and
// INV_OBJREF if the object no longer exists.
std::optional<DataPortStatus> status_of(const CORBA::SystemException& e) {
    const CORBA::Exception* thrown = &e;
    if (CORBA::TIMEOUT::_downcast(thrown) != nullptr) return std::nullopt;
    if (CORBA::TRANSIENT::_downcast(thrown) != nullptr || CORBA::COMM_FAILURE::_downcast(thrown) != nullptr ||
        CORBA::OBJECT_NOT_EXIST::_downcast(thrown) != nullptr ||
        CORBA::OBJ_ADAPTER::_downcast(thrown) != nullptr || CORBA::INV_OBJREF::_downcast(thrown) != nullptr)
        return DataPortStatus::CONNECTION_LOST;
    return DataPortStatus::PORT_ERROR;
}

bool is_responding(CORBA::Object_ptr object) {
    try {
        object->_non_existent();
    } catch (const CORBA::SystemException& e) {
        return status_of(e).has_value();
    }
    return true;
}

void set_call_timeout(CORBA::Object_ptr object, std::chrono::milliseconds timeout) {
    omniORB::setClientCallTimeout(object, static_cast<CORBA::ULong>(timeout.count()));
}

namespace {

// The two IDL interfaces differ only in the names of their operations and types.
auto call_put(OpenRTM::InPortCdr_ptr object, const OpenRTM::CdrData& data) { return object->put(data); }
auto call_put(RTC::DataPushService_ptr object, const RTC::OctetSeq& data) { return object->push(data); }
auto call_get(OpenRTM::OutPortCdr_ptr object, const OpenRTM::CdrData_out& data) { return object->get(data); }
auto call_get(RTC::DataPullService_ptr object, const RTC::OctetSeq_out& data) { return object->pull(data); }

/// A receiver by the IDL interface `Interface`, whose messages are sequences `Data`.
template <class Interface, class Data>
class CorbaReceiver : public RemoteReceiver {
  public:
    // Unchecked, because the profile names the interface, and a checked _narrow() would call the peer during
    // connecting.
    explicit CorbaReceiver(CORBA::Object_ptr object)
        : object_(Interface::_unchecked_narrow(object)), answers_(object) {}
    std::optional<DataPortStatus> put(const ByteData& bytes) override {
        const auto length = static_cast<CORBA::ULong>(bytes.getDataLength());
        const auto begun = answers_.now();
        try {
            // A sequence that refers to the existing bytes: `false` leaves them to their owner.
            const auto status = from_port_status(static_cast<OpenRTM::PortStatus>(
                call_put(object_.in(), Data(length, length, bytes.getBuffer(), false))));
            answers_.answered();
            return status;
        } catch (const CORBA::SystemException& e) {
            return answers_.failed(e, begun);
        }
    }
    void set_timeout(std::chrono::milliseconds timeout) override { set_call_timeout(object_.in(), timeout); }
    bool is_on_another_machine() const override { return answers_.is_on_another_machine(); }

  private:
    typename Interface::_var_type object_;
    PeerAnswers answers_;
};

/// A sender by the IDL interface `Interface`, whose messages are sequences `Data`.
template <class Interface, class Data>
class CorbaSender : public RemoteSender {
  public:
    explicit CorbaSender(CORBA::Object_ptr object)
        : object_(Interface::_unchecked_narrow(object)),
          is_on_another_machine_(!address_on_another_machine(object).empty()) {}
    std::optional<DataPortStatus> get(ByteData& bytes) override {
        try {
            typename Data::_var_type data;
            const DataPortStatus status =
                from_port_status(static_cast<OpenRTM::PortStatus>(call_get(object_.in(), data.out())));
            bytes.writeData(data->get_buffer(), data->length());
            return status;
        } catch (const CORBA::SystemException& e) {
            return answer_of(e);
        }
    }
    bool responds() override {
        try {
            object_->_non_existent();
        } catch (const CORBA::SystemException& e) {
            return answer_of(e).has_value();
        }
        return true;
    }
    void set_timeout(std::chrono::milliseconds timeout) override { set_call_timeout(object_.in(), timeout); }

  private:
    // A network failure is temporary, so it is not an answer.
    std::optional<DataPortStatus> answer_of(const CORBA::SystemException& e) {
        const auto status = status_of(e);
        if (status == DataPortStatus::CONNECTION_LOST && is_on_another_machine_ &&
            !is_object_gone(e, object_.in(), true))
            return std::nullopt;
        return status;
    }

    typename Interface::_var_type object_;
    const bool is_on_another_machine_;
};

} // namespace

std::unique_ptr<RemoteReceiver> RemoteReceiver::find(const ConnectorProfile& profile,
                                                     const std::string& interface_type) {
    CORBA::Object_var object = find_published_object(profile, address_key(interface_type, "inport"));
    if (CORBA::is_nil(object.in())) return nullptr;
    if (interface_type == "shared_memory") return create_shared_memory_receiver(object.in());
    if (interface_type == "data_service")
        return std::make_unique<CorbaReceiver<RTC::DataPushService, RTC::OctetSeq>>(object.in());
    return std::make_unique<CorbaReceiver<OpenRTM::InPortCdr, OpenRTM::CdrData>>(object.in());
}

std::unique_ptr<RemoteSender> RemoteSender::find(const ConnectorProfile& profile,
                                                 const std::string& interface_type) {
    CORBA::Object_var object = find_published_object(profile, address_key(interface_type, "outport"));
    if (CORBA::is_nil(object.in())) return nullptr;
    if (interface_type == "shared_memory") return create_shared_memory_sender(object.in());
    if (interface_type == "data_service")
        return std::make_unique<CorbaSender<RTC::DataPullService, RTC::OctetSeq>>(object.in());
    return std::make_unique<CorbaSender<OpenRTM::OutPortCdr, OpenRTM::CdrData>>(object.in());
}

std::string corba_interface_type(const coil::Properties& connector_properties) {
    const std::string type = coil::normalize(connector_properties.getProperty("interface_type"));
    return type == "data_service" || type == "shared_memory" ? type : "corba_cdr";
}

// OpenRTM-aist publishes the objects of shared_memory under the key of corba_cdr.
std::string address_key(const std::string& interface_type, const char* side) {
    return "dataport." + (interface_type == "shared_memory" ? "corba_cdr" : interface_type) + "." + side;
}

} // namespace RTC
