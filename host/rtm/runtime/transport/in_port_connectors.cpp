// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/in_port_connectors.hpp"
#include "host/rtm/runtime/transport/connection_profile.hpp"
#include "host/rtm/runtime/transport/remote_push.hpp"
#include <rtm/InPortBase.h>

namespace RTC {

InPortConnector::InPortConnector(ConnectorInfo& info, ConnectorListenersBase* listeners,
                                 CdrBufferBase* buffer)
    : m_profile(info), m_listeners(listeners), m_buffer(buffer),
      m_marshaling_type(info.properties.getProperty("marshaling_type", "cdr")),
      m_timestamp(timestampPolicy(info.properties)) {
    m_littleEndian = little_endian(info.properties);
}

InPortConnector::~InPortConnector() { SerializerFactory::instance().deleteObject(m_cdr); }

DataPortStatus InPortConnector::read(ByteDataStreamBase* stream) {
    const DataPortStatus status = read(m_bytes);
    if (status != DataPortStatus::PORT_OK) return status;
    stream->isLittleEndian(m_bytes.getEndian());
    stream->writeData(m_bytes.getBuffer(), m_bytes.getDataLength());
    return status;
}

DataPortStatus InPortConnector::read(ByteData& bytes) { return report(m_buffer->read(bytes), bytes); }

DataPortStatus InPortConnector::read(ByteDataStreamBase* stream, Unmarshal& use, bool& used) {
    if (m_listeners->has(ConnectorDataListenerType::ON_BUFFER_READ)) return read(stream);
    const DataPortStatus status = report(m_inPlace->readInPlace(m_bytes, use, used), m_bytes);
    if (status != DataPortStatus::PORT_OK || used) return status;
    stream->isLittleEndian(m_bytes.getEndian());
    stream->writeData(m_bytes.getBuffer(), m_bytes.getDataLength());
    return status;
}

DataPortStatus InPortConnector::report(BufferStatus status, ByteData& bytes) {
    switch (status) {
    case BufferStatus::OK:
        m_listeners->notify(ConnectorDataListenerType::ON_BUFFER_READ, m_profile, bytes, m_marshaling_type);
        return DataPortStatus::PORT_OK;
    case BufferStatus::EMPTY:
        m_listeners->notify(ConnectorListenerType::ON_BUFFER_EMPTY, m_profile);
        return DataPortStatus::BUFFER_EMPTY;
    case BufferStatus::TIMEOUT:
        m_listeners->notify(ConnectorListenerType::ON_BUFFER_READ_TIMEOUT, m_profile);
        return DataPortStatus::BUFFER_TIMEOUT;
    case BufferStatus::PRECONDITION_NOT_MET:
        return DataPortStatus::PRECONDITION_NOT_MET;
    default:
        return DataPortStatus::BUFFER_ERROR;
    }
}

BufferStatus InPortConnector::write(ByteData& bytes) { return m_buffer->write(bytes); }

InPortPushConnector::InPortPushConnector(InPortBase& port, ConnectorInfo& info, CdrBufferBase* buffer,
                                         bool own, std::shared_ptr<DirectLaneBase> lane)
    : InPortConnector(info, port.getListeners(), buffer), own_(own),
      inlet_(std::make_shared<DataInlet>(port, info, *buffer, lane)),
      servant_(make_servant(wire_interface(info.properties), inlet_, m_littleEndian)) {
    m_inPlace = inlet_->inPlace();
    m_lane = std::move(lane);
}

InPortPushConnector::~InPortPushConnector() {
    provider_.reset(); // nothing comes after that
    disconnect();
    if (own_) CdrBufferFactory::instance().deleteObject(m_buffer);
}

DataPortStatus InPortPushConnector::disconnect() {
    inlet_->close();
    return DataPortStatus::PORT_OK;
}

BufferStatus InPortPushConnector::write(ByteData& bytes) {
    if (provider_ != nullptr) return InPortConnector::write(bytes);
    return inlet_->receive(bytes) == DataPortStatus::PORT_OK ? BufferStatus::OK : BufferStatus::BUFFER_ERROR;
}

InPortPullConnector::InPortPullConnector(InPortBase& port, ConnectorInfo& info,
                                         std::shared_ptr<DataOutlet> local)
    : InPortConnector(info, port.getListeners(), &local->buffer()), local_(std::move(local)) {}

InPortPullConnector::InPortPullConnector(InPortBase& port, ConnectorInfo& info,
                                         std::unique_ptr<RemoteSender> remote)
    : InPortConnector(info, port.getListeners(), &unused_), remote_(std::move(remote)),
      patience_(RemotePush::bounds(info.properties).alone) {
    remote_->setTimeout(patience_);
}

DataPortStatus InPortPullConnector::read(ByteData& bytes) {
    const bool asked = ahead_.has_value();
    const DataPortStatus status = asked ? *ahead_ : local_ ? local_->fetch(bytes) : fetch(bytes);
    if (asked) {
        bytes = aheadBytes_;
        ahead_.reset();
    }
    if (status == DataPortStatus::PORT_OK)
        m_listeners->notify(ConnectorDataListenerType::ON_RECEIVED, m_profile, bytes, m_marshaling_type);
    return status;
}

bool InPortPullConnector::fetchAhead(bool final) {
    if (local_) return false;
    if (ahead_ != DataPortStatus::PORT_OK) ahead_ = fetch(aheadBytes_);
    if (ahead_ == DataPortStatus::PORT_OK) return true;
    if (!final) ahead_.reset();
    return false;
}

// The reader, often a component's cycle, waits for a sender that hangs once for long, then rarely and shortly
// until that answers again: to a question that takes no message from it.
std::optional<DataPortStatus> InPortPullConnector::ask(ByteData& bytes) {
    using namespace std::chrono_literals;
    if (doubt_ == 0ms || remote_->answers()) {
        if (doubt_ != 0ms) remote_->setTimeout(patience_);
        if (const auto answer = remote_->get(bytes)) {
            doubt_ = 0ms;
            return answer;
        }
    }
    doubt_ = doubt_ == 0ms ? 10ms : std::min<std::chrono::milliseconds>(2 * doubt_, 200ms);
    remote_->setTimeout(doubt_);
    retry_ = std::chrono::steady_clock::now() + 10 * doubt_;
    return std::nullopt;
}

DataPortStatus InPortPullConnector::fetch(ByteData& bytes) {
    if (std::chrono::steady_clock::now() < retry_) return DataPortStatus::RECV_TIMEOUT;
    bytes.isLittleEndian(m_littleEndian);
    const DataPortStatus status = ask(bytes).value_or(DataPortStatus::RECV_TIMEOUT);
    switch (status) {
    case DataPortStatus::PORT_OK:
        return status;
    case DataPortStatus::RECV_EMPTY:
        m_listeners->notify(ConnectorListenerType::ON_SENDER_EMPTY, m_profile);
        return DataPortStatus::BUFFER_EMPTY;
    case DataPortStatus::RECV_TIMEOUT:
        m_listeners->notify(ConnectorListenerType::ON_SENDER_TIMEOUT, m_profile);
        return status;
    default:
        m_listeners->notify(ConnectorListenerType::ON_SENDER_ERROR, m_profile);
        return status;
    }
}

} // namespace RTC
