// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/CdrRingBuffer.h>
#include <rtm/ConnectorListener.h>
#include <shared_mutex>

namespace RTC {

/// Where messages of one pull connector wait to be fetched, by a reader of this process or by the ORB. It
/// outlives the connector. [any-thread]
class PullBuffer {
  public:
    PullBuffer(ConnectorListeners& listeners, const ConnectorInfo& info);

    DataPortStatus put(ByteData& bytes);
    DataPortStatus fetch(ByteData& bytes);
    CdrBufferBase& buffer() { return buffer_; }
    void close();

  private:
    std::shared_mutex open_mutex_;
    bool open_ = true;
    ConnectorListeners& listeners_;
    ConnectorInfo info_;
    CdrRingBuffer buffer_;
    std::string marshaling_type_;
};

} // namespace RTC
