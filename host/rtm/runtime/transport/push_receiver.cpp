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
    const auto notify = [&](ConnectorDataListenerType event) {
        listeners_.notify(event, info_, bytes, marshaling_type_);
    };
    notify(ConnectorDataListenerType::ON_RECEIVED);
    return store([&] { return direct_buffer_ ? direct_buffer_->writeBytes(bytes) : buffer_.write(bytes); },
                 notify);
}

[[gnu::hot]] bool PushReceiver::receiveDirect(const DirectValue& message, DataPortStatus& status) {
    const tandem::rt::ShortLock lock(open_mutex_);
    if (!open_ || direct_buffer_ == nullptr || stamps_ || direct_buffer_->type() != message.type)
        return false;
    if (!listeners_.hasDataListener()) {
        status = portStatus(direct_buffer_->writeValue(message.value));
        return true;
    }
    if (!listeners_.allTakeValues(message.type)) return false;
    status = receiveValue(message);
    return true;
}

// Listeners may change the message, but not what the sender has.
DataPortStatus PushReceiver::receiveValue(const DirectValue& message) {
    direct_buffer_->copy(message.value, value_);
    const auto notify = [&](ConnectorDataListenerType event) {
        listeners_.notifyValue(event, info_, value_.get());
    };
    notify(ConnectorDataListenerType::ON_RECEIVED);
    const bool is_needed_then = listeners_.has(ConnectorDataListenerType::ON_BUFFER_WRITE);
    return store(
        [&] {
            return is_needed_then ? direct_buffer_->writeValue(value_.get())
                                  : direct_buffer_->takeValue(value_.get());
        },
        notify);
}

// Buffer and receiver events come in pairs: OpenRTM-aist calls listeners of both kinds on the receiving side.
template <class Write, class Notify>
DataPortStatus PushReceiver::store(const Write& write, const Notify& notify) {
    using Type = ConnectorDataListenerType;
    // Asking whether the buffer is full locks it: only for a listener that wants to know.
    if (listeners_.has(Type::ON_BUFFER_OVERWRITE) && full()) notify(Type::ON_BUFFER_OVERWRITE);
    const DataPortStatus status = portStatus(write());
    switch (status) {
    case DataPortStatus::PORT_OK:
        notify(Type::ON_BUFFER_WRITE);
        break;
    case DataPortStatus::BUFFER_FULL:
        notify(Type::ON_BUFFER_FULL);
        notify(Type::ON_RECEIVER_FULL);
        break;
    case DataPortStatus::BUFFER_TIMEOUT:
        notify(Type::ON_BUFFER_WRITE_TIMEOUT);
        notify(Type::ON_RECEIVER_TIMEOUT);
        break;
    default:
        notify(Type::ON_RECEIVER_ERROR);
    }
    return status;
}

void PushReceiver::close() {
    const std::lock_guard lock(open_mutex_);
    open_ = false;
}

} // namespace RTC
