// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "proxy/interceptor/corba/generic_servant.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/protocol/control.hpp"

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace tandem::interceptor {

/// Mirrors a service interface that the RTC requires and an OPRoS component provides: a CORBA object whose
/// calls cross the link, without a compiled skeleton. A failed call is a CORBA system exception: TIMEOUT,
/// COMM_FAILURE (peer gone), NO_RESOURCES (too many calls), BAD_OPERATION, BAD_PARAM, or UNKNOWN (the OPRoS
/// method failed; its text is in the log).
class MirrorRequiredPort final : private CallTarget {
  public:
    MirrorRequiredPort(link::Port port, link::Link& link, std::chrono::milliseconds call_timeout);

    GenericServant& servant() { return servant_; }
    const link::Port& port() const { return port_; }
    /// Learns the operations that the OPRoS component provides. Returns an empty string, or one line with both
    /// signatures if one differs from the IDL's. [worker-thread]
    std::string bind(const link::control::ServiceBinding& binding);

  private:
    // CallTarget, in ORB threads or the calling component's own.
    const Operation* find_operation(const char* name) override;
    std::vector<std::byte> call(const char* name, const Operation&, std::span<const std::byte>) override;
    void add_operation(const link::ServiceOperation& operation);

    const link::Port port_;
    link::Link& link_;
    const std::chrono::milliseconds call_timeout_;
    std::mutex mutex_; ///< operations_, retired_
    std::map<std::string, std::unique_ptr<Operation>, std::less<>> operations_;
    /// Operations that were replaced. They are kept, because calls that are being executed may still use them.
    std::vector<std::unique_ptr<Operation>> retired_;
    process::LogThrottle failed_calls_;
    GenericServant servant_;
};

} // namespace tandem::interceptor
