// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/interceptor/rtc_port.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tandem::interceptor {

/// Connects InterceptorComp's mirrors with the ports of the RTCs that the link shares. [one thread at a time]
class PortConnector {
  public:
    /// Properties of a connection by name.
    using Properties = std::vector<std::pair<const char*, std::string>>;

    /// `owner` has the mirrors and must outlive this object. `strict`: see leave_out().
    PortConnector(RTC::RTObject_impl& owner, bool strict) : owner_(owner), strict_(strict) {}

    /// Connects a mirror with the RTC's port, by a connection of that name. If that fails, leaves the port out and returns
    /// why.
    std::string connect(RTC::PortBase& mirror, const RtcPort& port, const std::string& name,
                        const Properties& properties);
    /// Reports why a port cannot be used: logs `reason`, so that the other ports still work, or, if `strict`, throws
    /// it as std::runtime_error.
    void leave_out(const std::string& reason);

  private:
    RTC::RTObject_impl& owner_;
    const bool strict_;
};

} // namespace tandem::interceptor
