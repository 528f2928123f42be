// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/proxy_port.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"

#include <string>

namespace tandem::interceptor {

/// The InPort that shows an input port of an OPRoS component. No data pass through this object: the buffer of each of its
/// connectors is a LinkBuffer, which writes to the ring of the link in the sender's thread.
class OprosInPort final : public engine::ProxyPort<RTC::InPortBase> {
  public:
    /// `channel_key` is the port's channel in LinkBuffer's registry.
    OprosInPort(const char* name, const char* data_type, std::string channel_key);
    void init(coil::Properties& properties) override;
    bool read(std::string) override { return false; }

  private:
    RTC::ReturnCode_t publishInterfaces(RTC::ConnectorProfile& profile) override;

    const std::string channel_key_;
};

} // namespace tandem::interceptor
