// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/stream/untyped_ports.hpp"

#include <csignal>
#include <fmt/format.h>
#include <rtm/CORBA_RTCUtil.h>

namespace tandem::command {
namespace {

constexpr std::size_t max_queued = 100000; // of a terminal that does not keep up, the newest are given up

volatile std::sig_atomic_t end_wanted = 0;

} // namespace

SampleQueue::ReturnCode SampleQueue::operator()(RTC::ConnectorInfo&, RTC::ByteData& data,
                                                const std::string&) {
    std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_.size() < max_queued) waiting_.push_back(data);
    wake_.notify_one();
    return NO_CHANGE;
}

bool SampleQueue::next(RTC::ByteData& bytes, std::chrono::milliseconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!wake_.wait_for(lock, timeout, [this] { return !waiting_.empty(); })) return false;
    bytes = waiting_.front();
    waiting_.pop_front();
    return true;
}

UntypedInPort::UntypedInPort(const char* name, const char* type)
    : InPortBase(name, type), samples_(new SampleQueue) {
    addProperty("dataport.marshaling_types", "cdr");
    addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, samples_);
}
bool UntypedInPort::read(std::string) { return false; }

UntypedOutPort::UntypedOutPort(const char* name, const char* type) : OutPortBase(name, type) {
    addProperty("dataport.marshaling_types", "cdr");
}

bool UntypedOutPort::littleEndian() {
    std::lock_guard<std::mutex> lock(m_connectorsMutex);
    return m_connectors.empty() || m_connectors.front()->isLittleEndian();
}

void UntypedOutPort::send(const RTC::ByteData& bytes) {
    RTC::ByteData message(bytes);
    std::lock_guard<std::mutex> lock(m_connectorsMutex);
    if (m_connectors.empty()) throw std::runtime_error("the port has disconnected");
    const RTC::DataPortStatus status = m_connectors.front()->write(message);
    if (status != RTC::DataPortStatus::PORT_OK)
        throw std::runtime_error(std::string("the port does not take the value: ") + RTC::toString(status));
}

std::string data_type(const RemotePort& port, const std::string& kind) {
    const std::string is = NVUtil::toString(port.profile->properties, "port.port_type");
    if (is != kind)
        throw std::runtime_error(
            fmt::format("{} is a {}, expected a {}", port.name, is.empty() ? "port" : is, kind));
    return NVUtil::toString(port.profile->properties, "dataport.data_type");
}

PortConnection::PortConnection(const RemotePort& remote_port, RTC::PortBase& ours,
                               const std::vector<std::string>& properties, const char* name)
    : ours_(ours) {
    call_remote(remote_port.name, [&] {
        RTC::PortService_var own = ours.getPortRef();
        RTC::ConnectorProfile_var profile = CORBA_RTCUtil::create_connector(
            name, connection_properties(properties), own.in(), remote_port.object.in());
        const RTC::ReturnCode_t code = ours.connect(profile.inout());
        if (code != RTC::RTC_OK)
            throw std::runtime_error(remote_port.name + " cannot be connected: " + ours.connectError());
        id_ = profile->connector_id;
    });
}

PortConnection::~PortConnection() { ours_.disconnect(id_.c_str()); }

bool interrupted() {
    static const bool installed = [] {
        for (int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, [](int) { end_wanted = 1; });
        return true;
    }();
    return installed && end_wanted != 0;
}

} // namespace tandem::command
