// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/stream/untyped_ports.hpp"

#include "apps/tandem/record/end_signals.hpp"

#include <csignal>
#include <fmt/format.h>
#include <rtm/CORBA_RTCUtil.h>
#include <string_view>

namespace tandem::command {
namespace {

// Limit for samples in memory, for a slow terminal. The newest samples are dropped.
constexpr std::size_t max_queued = 100000;

volatile std::sig_atomic_t stop_signal_received = 0;

} // namespace

// NO_CHANGE: listeners may replace the data, but nothing reads the data after this listener.
SampleQueue::ReturnCode SampleQueue::operator()(RTC::ConnectorInfo&, RTC::ByteData& data,
                                                const std::string&) {
    std::lock_guard<std::mutex> lock(mutex_);
    if (queue_.size() < max_queued) queue_.push_back(data);
    received_.notify_one();
    return NO_CHANGE;
}

bool SampleQueue::pop(RTC::ByteData& bytes, std::chrono::milliseconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!received_.wait_for(lock, timeout, [this] { return !queue_.empty(); })) return false;
    bytes = queue_.front();
    queue_.pop_front();
    return true;
}

UntypedInPort::UntypedInPort(const char* name, const char* type)
    : InPortBase(name, type), samples_(new SampleQueue) {
    // Without other serializers, the sender must choose CDR, which the TypeCode describes.
    addProperty("dataport.marshaling_types", "cdr");
    addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, samples_);
}

// The base class provides it for ports with a variable.
bool UntypedInPort::read(std::string) { return false; }

// The listener receives each sample. Stops at a repeated sample, because OpenRTM-aist's senders repeat their last
// sample when they have no other. Limits the number, because samples may be written as fast as they are fetched.
void UntypedInPort::fetch() {
    std::lock_guard<std::mutex> lock(m_connectorsMutex);
    auto text = [](const RTC::ByteData& bytes) {
        return std::string_view(reinterpret_cast<const char*>(bytes.getBuffer()), bytes.getDataLength());
    };
    for (auto* connector : m_connectors) {
        RTC::ByteData bytes, before;
        for (int i = 0; i < 1000 && connector->read(bytes) == RTC::DataPortStatus::PORT_OK; ++i) {
            if (i > 0 && text(bytes) == text(before)) break;
            before = bytes;
        }
    }
}

DeliveryCounter::ReturnCode DeliveryCounter::operator()(RTC::ConnectorInfo&, RTC::ByteData&,
                                                        const std::string&) {
    ++count_;
    return NO_CHANGE;
}

// ON_RECEIVED: the receiver has confirmed the sample. A receiver that pulls does not confirm, so ON_SEND is the last
// event at the sender.
UntypedOutPort::UntypedOutPort(const char* name, const char* type)
    : OutPortBase(name, type), pushed_(new DeliveryCounter), pulled_(new DeliveryCounter) {
    addProperty("dataport.marshaling_types", "cdr");
    addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, pushed_);
    addConnectorDataListener(RTC::ConnectorDataListenerType::ON_SEND, pulled_);
}

std::size_t UntypedOutPort::delivered() const {
    std::lock_guard<std::mutex> lock(m_connectorsMutex);
    const bool pulls = !m_connectors.empty() &&
                       m_connectors.front()->profile().properties.getProperty("dataflow_type") == "pull";
    return (pulls ? pulled_ : pushed_)->count();
}

// Returns true if there is no connection.
bool UntypedOutPort::is_little_endian() {
    std::lock_guard<std::mutex> lock(m_connectorsMutex);
    return m_connectors.empty() || m_connectors.front()->isLittleEndian();
}

// Sends only to the first connection, because the bytes are in its byte order and PortConnection makes no other.
void UntypedOutPort::send(const RTC::ByteData& bytes, const std::string& receiver) {
    RTC::ByteData message(bytes); // write() takes a non-const reference
    std::lock_guard<std::mutex> lock(m_connectorsMutex);
    if (m_connectors.empty()) throw ConnectionLost(receiver + " has disconnected");
    const RTC::DataPortStatus status = m_connectors.front()->write(message);
    if (status == RTC::DataPortStatus::CONNECTION_LOST)
        throw ConnectionLost(receiver + " disconnected, or its host ended, while a value was sent");
    if (status != RTC::DataPortStatus::PORT_OK)
        throw std::runtime_error(receiver + " does not accept the value: " + RTC::toString(status));
}

std::string require_data_type(const RemotePort& port, const std::string& kind) {
    const std::string actual_kind = NVUtil::toString(port.profile->properties, "port.port_type");
    if (actual_kind != kind)
        throw std::runtime_error(fmt::format("{} is a {}: expected a {}", port.name,
                                             actual_kind.empty() ? "port" : actual_kind, kind));
    return NVUtil::toString(port.profile->properties, "dataport.data_type");
}

PortConnection::PortConnection(const RemotePort& remote_port, RTC::PortBase& own_port,
                               const std::vector<std::string>& properties, const char* name)
    : remote_(RTC::PortService::_duplicate(remote_port.object.in())), own_port_(own_port) {
    call_remote(remote_port.name, [&] {
        RTC::PortService_var own = own_port.getPortRef();
        RTC::ConnectorProfile_var profile = CORBA_RTCUtil::create_connector(
            name, connection_properties(properties), own.in(), remote_port.object.in());
        const RTC::ReturnCode_t code = own_port.connect(profile.inout());
        if (code != RTC::RTC_OK)
            throw std::runtime_error(remote_port.name + " cannot be connected: " + own_port.connectError());
        id_ = profile->connector_id;
    });
}

PortConnection::~PortConnection() { own_port_.disconnect(id_.c_str()); }

bool PortConnection::exists_at_remote_port() const {
    try {
        RTC::ConnectorProfile_var profile = remote_->get_connector_profile(id_.c_str());
        return id_ == profile->connector_id.in();
    } catch (const CORBA::SystemException&) {
        return true; // the port itself detects a host that is gone
    }
}

bool interrupted() {
    static const bool installed = [] {
        handle_end_signals([](int) { stop_signal_received = 1; });
        return true;
    }();
    return installed && stop_signal_received != 0;
}

} // namespace tandem::command
