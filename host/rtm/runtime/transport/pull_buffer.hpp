// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/buffer/port_buffer.hpp"
#include <rtm/ConnectorListener.h>
#include <shared_mutex>

namespace RTC {

/// The buffer of one pull connection, on the OutPort's side: the writer puts messages in, a reader of this
/// process or an ORB thread fetches them. Shared with the servant that fetches, so it may outlive the
/// connector: after close() both get CONNECTION_LOST. [any-thread]
class PullBuffer {
  public:
    /// The ring buffer is set up from `info.properties`, node `buffer`. `listeners` are the OutPort's.
    PullBuffer(ConnectorListeners& listeners, const ConnectorInfo& info);
    /// Stores one message. Returns BUFFER_FULL or BUFFER_TIMEOUT if the full-policy refuses it.
    DataPortStatus put(ByteData& bytes);
    /// Takes the oldest message. Returns BUFFER_EMPTY or BUFFER_TIMEOUT if there is none.
    DataPortStatus fetch(ByteData& bytes);
    CdrBufferBase& buffer() { return buffer_; }
    /// Returns when no put() or fetch() is in progress. The listeners are not called after that.
    void close();

  private:
    std::shared_mutex open_mutex_; // shared by put() and fetch(), exclusive to close()
    bool open_ = true;
    ConnectorListeners& listeners_;
    ConnectorInfo info_;
    PortBuffer buffer_;
    std::string marshaling_type_;
};

} // namespace RTC
