// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/out_port_connectors.hpp"
#include "host/rtm/runtime/transport/connection_profile.hpp"
#include <rtm/OutPortBase.h>

namespace RTC {

OutPortConnector::OutPortConnector(ConnectorInfo& info, ConnectorListenersBase* listeners)
    : m_profile(info), m_littleEndian(is_little_endian(info.properties)), m_listeners(listeners),
      m_marshaling_type(info.properties.getProperty("marshaling_type", "cdr")),
      m_timestamp(timestampPolicy(info.properties)) {}

OutPortConnector::~OutPortConnector() = default;

DataPortStatus OutPortConnector::write(ByteDataStreamBase* stream) {
    m_bytes = *stream;
    m_bytes.isLittleEndian(isLittleEndian());
    return write(m_bytes);
}

BufferStatus OutPortConnector::read(ByteData& bytes) {
    CdrBufferBase* buffer = getBuffer();
    return buffer == nullptr ? BufferStatus::PRECONDITION_NOT_MET : buffer->read(bytes);
}

// Connectors that cannot do so fall back to write(bytes).
bool OutPortConnector::writeInPlace(const Marshal&, DataPortStatus&) { return false; }

bool OutPortConnector::writeDirect(const DirectValue&, DataPortStatus&) { return false; }

bool OutPortConnector::canShareBytesOf(const OutPortConnector& other) const {
    // A message that was sent in place never existed as bytes, and a stamp makes the message differ between connectors.
    auto stamps = [](TimestampPolicy p) {
        return p == TimestampPolicy::on_write || p == TimestampPolicy::on_send;
    };
    return !m_direct && !other.m_sentInPlace && m_littleEndian == other.m_littleEndian &&
           m_marshaling_type == other.m_marshaling_type && !stamps(m_timestamp) && !stamps(other.m_timestamp);
}

void OutPortPushConnector::rehearse(const Marshal& marshal) {
    const bool has_in_place_buffer = m_minInPlaceLength != static_cast<unsigned long>(-1);
    DataPortStatus ignored;
    if (has_in_place_buffer) writeInPlace(marshal, ignored);
}

OutPortPushConnector::OutPortPushConnector(OutPortBase& port, ConnectorInfo& info,
                                           std::shared_ptr<PushReceiver> local)
    : OutPortConnector(info, port.getListeners()), local_receiver_(std::move(local)) {
    m_direct = local_receiver_->direct_buffer() != nullptr;
    // A publisher's thread takes bytes. A direct connection carries unserialized values, in the writer's
    // thread.
    if (!m_direct)
        publisher_ = Publisher::create(m_profile.properties, m_profile.name,
                                       [this](ByteData& bytes) { return publish(bytes); });
    if (local_receiver_->in_place_buffer() != nullptr && !publisher_)
        m_minInPlaceLength = local_receiver_->in_place_buffer()->minInPlaceLength();
}

OutPortPushConnector::OutPortPushConnector(OutPortBase& port, ConnectorInfo& info,
                                           std::unique_ptr<RemoteReceiver> remote)
    : OutPortConnector(info, port.getListeners()), remote_receiver_(std::move(remote)),
      publisher_(Publisher::create(m_profile.properties, m_profile.name,
                                   [this](ByteData& bytes) { return publish(bytes); })) {
    const auto limits = RemotePush::limits_from(info.properties);
    if (publisher_ && remote_receiver_->is_on_another_machine())
        remote_receiver_->set_timeout(limits.thread_answer_timeout);
    if (!publisher_)
        remote_push_ = std::make_unique<RemotePush>(std::move(remote_receiver_), limits, info.name);
}

OutPortPushConnector::OutPortPushConnector(OutPortBase& port, ConnectorInfo& info,
                                           std::unique_ptr<NumberedReceiver> remote)
    : OutPortConnector(info, port.getListeners()),
      newest_push_(std::make_unique<NewestPush>(std::move(remote))),
      publisher_(Publisher::create(m_profile.properties, m_profile.name,
                                   [this](ByteData& bytes) { return publish(bytes); })) {}

OutPortPushConnector::~OutPortPushConnector() { disconnect(); }

DataPortStatus OutPortPushConnector::disconnect() {
    publisher_.reset();
    return DataPortStatus::PORT_OK;
}

DataPortStatus OutPortPushConnector::write(ByteData& bytes) {
    if (!publisher_) return deliver(bytes);
    using Type = ConnectorDataListenerType;
    m_listeners->notify(Type::ON_BUFFER_WRITE, m_profile, bytes, m_marshaling_type);
    bool overwritten = false;
    const DataPortStatus status = publisher_->write(bytes, overwritten);
    if (overwritten) m_listeners->notify(Type::ON_BUFFER_OVERWRITE, m_profile, bytes, m_marshaling_type);
    if (status == DataPortStatus::BUFFER_FULL)
        m_listeners->notify(Type::ON_BUFFER_FULL, m_profile, bytes, m_marshaling_type);
    if (status == DataPortStatus::BUFFER_TIMEOUT)
        m_listeners->notify(Type::ON_BUFFER_WRITE_TIMEOUT, m_profile, bytes, m_marshaling_type);
    return status;
}

// [publisher's thread] May run before publisher_ is set and until publisher_.reset() returns, so this function does not
// use publisher_.
DataPortStatus OutPortPushConnector::publish(ByteData& bytes) {
    m_listeners->notify(ConnectorDataListenerType::ON_BUFFER_READ, m_profile, bytes, m_marshaling_type);
    return deliver(bytes);
}

// Sends one message, in the writer's or the publisher's thread, and calls the listeners of the outcome.
DataPortStatus OutPortPushConnector::deliver(ByteData& bytes) {
    using Type = ConnectorDataListenerType;
    m_listeners->notify(Type::ON_SEND, m_profile, bytes, m_marshaling_type);
    const DataPortStatus status = send(bytes);
    switch (status) {
    case DataPortStatus::PORT_OK:
        m_listeners->notify(Type::ON_RECEIVED, m_profile, bytes, m_marshaling_type);
        break;
    case DataPortStatus::BUFFER_FULL:
    case DataPortStatus::SEND_FULL:
        m_listeners->notify(Type::ON_RECEIVER_FULL, m_profile, bytes, m_marshaling_type);
        break;
    case DataPortStatus::BUFFER_TIMEOUT:
    case DataPortStatus::SEND_TIMEOUT:
        m_listeners->notify(Type::ON_RECEIVER_TIMEOUT, m_profile, bytes, m_marshaling_type);
        break;
    default:
        m_listeners->notify(Type::ON_RECEIVER_ERROR, m_profile, bytes, m_marshaling_type);
        if (!local_receiver_) errors_.note(m_profile, "receiver", status);
    }
    return status;
}

DataPortStatus OutPortPushConnector::send(ByteData& bytes) {
    if (local_receiver_) return local_receiver_->receive(bytes);
    if (remote_push_) return remote_push_->write(bytes, is_sole_connector_);
    if (newest_push_) return newest_push_->write(bytes);
    return remote_receiver_->put(bytes).value_or(DataPortStatus::SEND_TIMEOUT);
}

bool OutPortPushConnector::writeDirect(const DirectValue& message, DataPortStatus& status) {
    return !m_listeners->hasDataListener() && local_receiver_->receive_direct(message, status);
}

OutPortPullConnector::OutPortPullConnector(OutPortBase& port, ConnectorInfo& info)
    : OutPortConnector(info, port.getListeners()),
      pull_buffer_(std::make_shared<PullBuffer>(*port.getListeners(), info)),
      servant_(create_servant(corba_interface_type(info.properties), pull_buffer_), &port) {}

OutPortPullConnector::~OutPortPullConnector() {
    provider_.reset(); // first: the transport reads from this connector until its provider is destroyed
    disconnect();
}

DataPortStatus OutPortPullConnector::disconnect() {
    pull_buffer_->close();
    return DataPortStatus::PORT_OK;
}

DataPortStatus OutPortPullConnector::write(ByteData& bytes) { return pull_buffer_->put(bytes); }

} // namespace RTC
