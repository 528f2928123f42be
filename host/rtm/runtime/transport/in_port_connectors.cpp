// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/in_port_connectors.hpp"
#include "host/rt/rehearsal.hpp"
#include "host/rtm/runtime/transport/connection_profile.hpp"
#include "host/rtm/runtime/transport/newest/numbered_in_port.hpp"
#include "host/rtm/runtime/transport/publisher.hpp"
#include "host/rtm/runtime/transport/remote_push.hpp"
#include "host/rtm/runtime/transport/ring/ring_in_port.hpp"
#include <rtm/InPortBase.h>

namespace RTC {

InPortConnector::InPortConnector(ConnectorInfo& info, ConnectorListenersBase* listeners,
                                 CdrBufferBase* buffer)
    : m_profile(info), m_listeners(listeners), m_buffer(buffer),
      m_marshaling_type(info.properties.getProperty("marshaling_type", "cdr")),
      m_timestamp(timestampPolicy(info.properties)) {
    m_littleEndian = is_little_endian(info.properties);
}

InPortConnector::~InPortConnector() = default;

DataPortStatus InPortConnector::read(ByteDataStreamBase* stream) {
    const DataPortStatus status = read(m_bytes);
    if (status == DataPortStatus::PORT_OK) copyTo(stream);
    return status;
}

void InPortConnector::copyTo(ByteDataStreamBase* stream) const {
    stream->isLittleEndian(m_bytes.getEndian());
    stream->writeData(m_bytes.getBuffer(), m_bytes.getDataLength());
}

DataPortStatus InPortConnector::read(ByteData& bytes) {
    return notifyReadResult(m_buffer->read(bytes), bytes);
}

DataPortStatus InPortConnector::read(ByteDataStreamBase* stream, Unmarshal& reader, bool& read_in_place) {
    // A listener needs the bytes and may change them, so the message is then copied.
    if (m_listeners->has(ConnectorDataListenerType::ON_BUFFER_READ)) return read(stream);
    const BufferStatus found = m_inPlace->readInPlace(m_bytes, reader, read_in_place);
    if (found == BufferStatus::OK && read_in_place) return DataPortStatus::PORT_OK; // there is no listener
    const DataPortStatus status = notifyReadResult(found, m_bytes);
    if (status == DataPortStatus::PORT_OK) copyTo(stream);
    return status;
}

// Calls the listeners for the result of a read and returns the result as the port's status.
DataPortStatus InPortConnector::notifyReadResult(BufferStatus status, ByteData& bytes) {
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

DataPortStatus InPortConnector::notifyNothingRead(BufferStatus status) {
    return tandem::rt::rehearsing() ? DataPortStatus::BUFFER_EMPTY : notifyReadResult(status, m_bytes);
}

BufferStatus InPortConnector::write(ByteData& bytes) { return m_buffer->write(bytes); }

InPortPushConnector::InPortPushConnector(InPortBase& port, ConnectorInfo& info, CdrBufferBase* buffer,
                                         bool owns_buffer, std::shared_ptr<DirectBufferBase> direct_buffer)
    : InPortConnector(info, port.getListeners(), buffer), owns_buffer_(owns_buffer),
      receiver_(std::make_shared<PushReceiver>(port, info, *buffer, direct_buffer)),
      servant_(create_servant(corba_interface_type(info.properties), receiver_, m_littleEndian), &port) {
    if (corba_interface_type(info.properties) == "corba_cdr" &&
        Publisher::delivers_newest_only(info.properties))
        numbered_servant_ =
            std::make_unique<ServantHolder>(create_numbered_servant(receiver_, m_littleEndian), &port);
    m_inPlace = receiver_->in_place_buffer();
    m_directBuffer = std::move(direct_buffer);
}

InPortPushConnector::~InPortPushConnector() {
    provider_.reset(); // first: the transport writes into this connector until its provider is destroyed
    disconnect();
    if (owns_buffer_) CdrBufferFactory::instance().deleteObject(m_buffer);
}

DataPortStatus InPortPushConnector::disconnect() {
    receiver_->close();
    return DataPortStatus::PORT_OK;
}

const ServantHolder& InPortPushConnector::offer_ring(const PortBase& port) {
    ring_servant_ = std::make_unique<ServantHolder>(create_ring_servant(receiver_, m_littleEndian), &port);
    m_takesArrived = true;
    m_inPlace = nullptr; // reading in place would not look for messages in the ring
    return *ring_servant_;
}

DataPortStatus InPortPushConnector::read(ByteData& bytes) {
    if (m_takesArrived) takeArrived();
    return InPortConnector::read(bytes);
}

BufferStatus InPortPushConnector::write(ByteData& bytes) {
    // A library's provider calls the ON_RECEIVED listeners itself. PushReceiver would call them again.
    if (provider_ != nullptr) return InPortConnector::write(bytes);
    return receiver_->receive(bytes) == DataPortStatus::PORT_OK ? BufferStatus::OK
                                                                : BufferStatus::BUFFER_ERROR;
}

InPortPullConnector::InPortPullConnector(InPortBase& port, ConnectorInfo& info,
                                         std::shared_ptr<PullBuffer> local)
    : InPortConnector(info, port.getListeners(), &local->buffer()), local_(std::move(local)) {}

InPortPullConnector::InPortPullConnector(InPortBase& port, ConnectorInfo& info,
                                         std::unique_ptr<RemoteSender> remote)
    : InPortConnector(info, port.getListeners(), &unused_buffer_), remote_(std::move(remote)),
      answer_timeout_(RemotePush::limits_from(info.properties).sole_answer_timeout) {
    remote_->set_timeout(answer_timeout_);
}

DataPortStatus InPortPullConnector::read(ByteData& bytes) {
    DataPortStatus status;
    if (prefetched_status_) {
        status = *prefetched_status_;
        bytes = prefetched_bytes_;
        prefetched_status_.reset();
    } else {
        status = local_ ? local_->fetch(bytes) : fetch(bytes);
    }
    if (status == DataPortStatus::PORT_OK)
        m_listeners->notify(ConnectorDataListenerType::ON_RECEIVED, m_profile, bytes, m_marshaling_type);
    return status;
}

bool InPortPullConnector::prefetch(bool keep_failure) {
    if (local_) return false; // its buffer says whether there is a message
    if (prefetched_status_ != DataPortStatus::PORT_OK) prefetched_status_ = fetch(prefetched_bytes_);
    if (prefetched_status_ == DataPortStatus::PORT_OK) return true;
    if (!keep_failure) prefetched_status_.reset();
    return false;
}

// The reader is often a component's cycle, which a hanging sender must not stop. So the reader waits for the full
// answer_timeout_ only once. After that it probes the sender until the sender answers again. The time limit of a probe
// grows from 10 to 200 ms, and the pause between probes is ten times as long. A probe takes no message, because an
// answer that arrived too late would lose one.
std::optional<DataPortStatus> InPortPullConnector::request_message(ByteData& bytes) {
    using namespace std::chrono_literals;
    if (probe_timeout_ == 0ms || remote_->responds()) {
        if (probe_timeout_ != 0ms) remote_->set_timeout(answer_timeout_);
        if (const auto answer = remote_->get(bytes)) {
            probe_timeout_ = 0ms;
            return answer;
        }
    }
    probe_timeout_ =
        probe_timeout_ == 0ms ? 10ms : std::min<std::chrono::milliseconds>(2 * probe_timeout_, 200ms);
    remote_->set_timeout(probe_timeout_);
    next_request_time_ = std::chrono::steady_clock::now() + 10 * probe_timeout_;
    return std::nullopt;
}

DataPortStatus InPortPullConnector::fetch(ByteData& bytes) {
    if (std::chrono::steady_clock::now() < next_request_time_) return DataPortStatus::RECV_TIMEOUT;
    bytes.isLittleEndian(m_littleEndian);
    const DataPortStatus status = request_message(bytes).value_or(DataPortStatus::RECV_TIMEOUT);
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
        errors_.note(m_profile, "sender", status);
        return status;
    }
}

} // namespace RTC
