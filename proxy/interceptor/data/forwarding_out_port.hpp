// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "proxy/interceptor/data/link_buffer.hpp"
#include "proxy/interceptor/engine/proxy_port.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"

#include <string>

namespace tandem::interceptor {

/// An OutPort with a data type known only at run time. It forwards messages from the link to all connected ports, without
/// encoding them again.
class ForwardingOutPort final : public engine::ProxyPort<RTC::OutPortBase> {
  public:
    /// `channel_key` is the port's channel in LinkBuffer's registry.
    ForwardingOutPort(const char* name, const char* data_type, const std::string& channel_key);

    /// Sends all messages that have come, except those that cannot be decoded, which are counted. May block as long as
    /// OutPort::write() for each message. [one thread at a time]
    void forward();
    /// Drops all messages that came while no port was connected. [any-thread]
    void discard() { buffer_.reset(); }
    bool is_connected();
    bool write() override { return false; }

  private:
    RTC::ReturnCode_t publishInterfaces(RTC::ConnectorProfile& profile) override;
    void send();
    void report_not_taken(RTC::DataPortStatus status);
    RTC::DataPortStatus write_to(RTC::OutPortConnector& connector);

    LinkBuffer buffer_;
    RTC::ByteData message_;
    process::LogThrottle thrown_, not_taken_;
};

} // namespace tandem::interceptor
