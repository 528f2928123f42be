// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/push_receiver.hpp"
#include <rtm/InPortBase.h>

namespace RTC {

PushReceiver::PushReceiver(InPortBase& port, const ConnectorInfo& info, CdrBufferBase& buffer,
                           std::shared_ptr<DirectBufferBase> direct_buffer)
    : port_(port), listeners_(*port.getListeners()), info_(info), buffer_(buffer),
      direct_buffer_(std::move(direct_buffer)), in_place_(dynamic_cast<InPlaceBuffer*>(&buffer)),
      marshaling_type_(info.properties.getProperty("marshaling_type", "cdr")),
      stamps_(timestampPolicy(info.properties) == TimestampPolicy::on_received) {}

[[gnu::hot]] DataPortStatus PushReceiver::receive(ByteData& bytes) {
    const tandem::rt::ShortLock lock(open_mutex_);
    return receiveLocked(bytes);
}

DataPortStatus PushReceiver::receiveNumbered(std::uint64_t number, ByteData& bytes) {
    const std::lock_guard lock(open_mutex_);
    if (open_ && number <= newest_number_) return DataPortStatus::PORT_OK;
    newest_number_ = number;
    return receiveLocked(bytes);
}

[[gnu::hot]] DataPortStatus PushReceiver::receiveLocked(ByteData& bytes) {
    if (!open_) return DataPortStatus::CONNECTION_LOST;
    if (stamps_) port_.stampOnReceive(bytes);
    listeners_.notify(ConnectorDataListenerType::ON_RECEIVED, info_, bytes, marshaling_type_);
    return store(bytes);
}

[[gnu::hot]] bool PushReceiver::receiveDirect(const DirectWriter& writer, DataPortStatus& status) {
    const tandem::rt::ShortLock lock(open_mutex_);
    if (!open_ || direct_buffer_ == nullptr || needsBytes()) return false;
    const BufferStatus written = writer(*direct_buffer_);
    status = portStatus(written);
    return written != BufferStatus::NOT_SUPPORTED;
}

// Buffer and receiver events come in pairs: OpenRTM-aist calls listeners of both kinds on the receiving side.
DataPortStatus PushReceiver::store(ByteData& bytes) {
    using Type = ConnectorDataListenerType;
    // Asking whether the buffer is full locks it: only for a listener that wants to know.
    if (listeners_.has(Type::ON_BUFFER_OVERWRITE) && full())
        listeners_.notify(Type::ON_BUFFER_OVERWRITE, info_, bytes, marshaling_type_);
    switch (direct_buffer_ ? direct_buffer_->writeBytes(bytes) : buffer_.write(bytes)) {
    case BufferStatus::OK:
        listeners_.notify(Type::ON_BUFFER_WRITE, info_, bytes, marshaling_type_);
        return DataPortStatus::PORT_OK;
    case BufferStatus::FULL:
        listeners_.notify(Type::ON_BUFFER_FULL, info_, bytes, marshaling_type_);
        listeners_.notify(Type::ON_RECEIVER_FULL, info_, bytes, marshaling_type_);
        return DataPortStatus::BUFFER_FULL;
    case BufferStatus::TIMEOUT:
        listeners_.notify(Type::ON_BUFFER_WRITE_TIMEOUT, info_, bytes, marshaling_type_);
        listeners_.notify(Type::ON_RECEIVER_TIMEOUT, info_, bytes, marshaling_type_);
        return DataPortStatus::BUFFER_TIMEOUT;
    default:
        listeners_.notify(Type::ON_RECEIVER_ERROR, info_, bytes, marshaling_type_);
        return DataPortStatus::PORT_ERROR;
    }
}

void PushReceiver::close() {
    const std::lock_guard lock(open_mutex_);
    open_ = false;
}

} // namespace RTC
