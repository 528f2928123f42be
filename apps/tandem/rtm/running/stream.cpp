// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/stream.hpp"

#include <csignal>
#include <fmt/format.h>
#include <rtm/CORBA_RTCUtil.h>

namespace tandem::command {
namespace {

constexpr std::size_t most_waiting = 100000; // of a terminal that does not keep up, the newest are given up

volatile std::sig_atomic_t end_wanted = 0;

} // namespace

Arrivals::ReturnCode Arrivals::operator()(RTC::ConnectorInfo&, RTC::ByteData& data, const std::string&) {
    std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_.size() < most_waiting) waiting_.push_back(data);
    wake_.notify_one();
    return NO_CHANGE;
}

bool Arrivals::next(RTC::ByteData& bytes, std::chrono::milliseconds patience) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!wake_.wait_for(lock, patience, [this] { return !waiting_.empty(); })) return false;
    bytes = waiting_.front();
    waiting_.pop_front();
    return true;
}

AnyIn::AnyIn(const char* name, const char* type) : InPortBase(name, type), arrivals_(new Arrivals) {
    addProperty("dataport.marshaling_types", "cdr");
    addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, arrivals_);
}
bool AnyIn::read(std::string) { return false; }

AnyOut::AnyOut(const char* name, const char* type) : OutPortBase(name, type) {
    addProperty("dataport.marshaling_types", "cdr");
}

bool AnyOut::littleEndian() {
    std::lock_guard<std::mutex> lock(m_connectorsMutex);
    return m_connectors.empty() || m_connectors.front()->isLittleEndian();
}

void AnyOut::send(const RTC::ByteData& bytes) {
    RTC::ByteData message(bytes);
    std::lock_guard<std::mutex> lock(m_connectorsMutex);
    if (m_connectors.empty()) throw std::runtime_error("the port has disconnected");
    const RTC::DataPortStatus status = m_connectors.front()->write(message);
    if (status != RTC::DataPortStatus::PORT_OK)
        throw std::runtime_error(std::string("the port does not take the value: ") + RTC::toString(status));
}

std::string data_type(const Port& port, const std::string& kind) {
    const std::string is = NVUtil::toString(port.profile->properties, "port.port_type");
    if (is != kind)
        throw std::runtime_error(
            fmt::format("{} is a {}, expected a {}", port.name, is.empty() ? "port" : is, kind));
    return NVUtil::toString(port.profile->properties, "dataport.data_type");
}

StreamConnection::StreamConnection(const Port& theirs, RTC::PortBase& ours,
                                   const std::vector<std::string>& properties, const char* name)
    : ours_(ours) {
    calling(theirs.name, [&] {
        RTC::PortService_var own = ours.getPortRef();
        RTC::ConnectorProfile_var profile = CORBA_RTCUtil::create_connector(
            name, connection_properties(properties), own.in(), theirs.object.in());
        const RTC::ReturnCode_t code = ours.connect(profile.inout());
        if (code != RTC::RTC_OK)
            throw std::runtime_error(theirs.name + " cannot be connected: " + ours.connectError());
        id_ = profile->connector_id;
    });
}

StreamConnection::~StreamConnection() { ours_.disconnect(id_.c_str()); }

bool interrupted() {
    static const bool installed = [] {
        for (int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, [](int) { end_wanted = 1; });
        return true;
    }();
    return installed && end_wanted != 0;
}

} // namespace tandem::command
