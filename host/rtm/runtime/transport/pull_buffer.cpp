// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/pull_buffer.hpp"

namespace RTC {

PullBuffer::PullBuffer(ConnectorListeners& listeners, const ConnectorInfo& info)
    : listeners_(listeners), info_(info),
      marshaling_type_(info.properties.getProperty("marshaling_type", "cdr")) {
    buffer_.init(info_.properties.getNode("buffer"));
}

DataPortStatus PullBuffer::put(ByteData& bytes) {
    using Type = ConnectorDataListenerType;
    std::shared_lock<std::shared_mutex> lock(open_mutex_);
    if (!open_) return DataPortStatus::CONNECTION_LOST;
    bool overwritten = false;
    switch (buffer_.writeReporting(bytes, overwritten)) {
    case BufferStatus::OK:
        if (overwritten) listeners_.notify(Type::ON_BUFFER_OVERWRITE, info_, bytes, marshaling_type_);
        listeners_.notify(Type::ON_BUFFER_WRITE, info_, bytes, marshaling_type_);
        return DataPortStatus::PORT_OK;
    case BufferStatus::FULL:
        listeners_.notify(Type::ON_BUFFER_FULL, info_, bytes, marshaling_type_);
        return DataPortStatus::BUFFER_FULL;
    case BufferStatus::TIMEOUT:
        listeners_.notify(Type::ON_BUFFER_WRITE_TIMEOUT, info_, bytes, marshaling_type_);
        return DataPortStatus::BUFFER_TIMEOUT;
    default:
        return DataPortStatus::BUFFER_ERROR;
    }
}

// The listeners of both the buffer and the sender are called: the two are one place on this side.
DataPortStatus PullBuffer::fetch(ByteData& bytes) {
    std::shared_lock<std::shared_mutex> lock(open_mutex_);
    if (!open_) return DataPortStatus::CONNECTION_LOST;
    switch (buffer_.read(bytes)) {
    case BufferStatus::OK:
        listeners_.notify(ConnectorDataListenerType::ON_BUFFER_READ, info_, bytes, marshaling_type_);
        listeners_.notify(ConnectorDataListenerType::ON_SEND, info_, bytes, marshaling_type_);
        return DataPortStatus::PORT_OK;
    case BufferStatus::EMPTY:
        listeners_.notify(ConnectorListenerType::ON_BUFFER_EMPTY, info_);
        listeners_.notify(ConnectorListenerType::ON_SENDER_EMPTY, info_);
        return DataPortStatus::BUFFER_EMPTY;
    case BufferStatus::TIMEOUT:
        listeners_.notify(ConnectorListenerType::ON_BUFFER_READ_TIMEOUT, info_);
        listeners_.notify(ConnectorListenerType::ON_SENDER_TIMEOUT, info_);
        return DataPortStatus::BUFFER_TIMEOUT;
    default:
        listeners_.notify(ConnectorListenerType::ON_SENDER_ERROR, info_);
        return DataPortStatus::BUFFER_ERROR;
    }
}

// The exclusive lock is granted when all put() and fetch() have returned.
void PullBuffer::close() {
    std::unique_lock<std::shared_mutex> lock(open_mutex_);
    open_ = false;
}

} // namespace RTC
