// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/link.hpp"

#include <ProvidedServicePort.h>

#include <chrono>
#include <map>
#include <string>

namespace tandem::adaptor {

/// Mirrors a service port that the peer provides: an OPRoS component's calls are carried to it and wait
/// for the reply, never longer than the call time-out. Failures are thrown as MethodInvokeException, one
/// line each.
class MirrorProvidedPort final : public ProvidedServicePort {
  public:
    MirrorProvidedPort(link::Port peer, link::Link& link, std::chrono::milliseconds call_timeout);

    bool isDynamic() const override { return true; }
    /// At connection: the method's signature must be the peer's, where the peer knows its own.
    std::string bindMethod(Method* required) override;
    ReturnType callService(std::string& name, std::vector<opros_params>& arguments,
                           opros_params& result) override;
    using ProvidedServicePort::callService;

  private:
    const link::Port peer_;
    link::Link& link_;
    const std::chrono::milliseconds call_timeout_;
    std::map<std::string, std::string> signatures_; ///< of bound methods; complete before anybody calls
};

} // namespace tandem::adaptor
