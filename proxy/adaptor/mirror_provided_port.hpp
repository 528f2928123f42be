// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/link.hpp"

#include <ProvidedServicePort.h>

#include <chrono>
#include <map>
#include <string>

namespace tandem::adaptor {

/// Mirrors a service port that the partner provides: an OPRoS component's calls are carried to it and wait
/// for the answer, never longer than the call time-out. Failures are thrown as MethodInvokeException, one
/// line each.
class MirroredProvided final : public ProvidedServicePort {
  public:
    MirroredProvided(link::Port partner, link::Link& link, std::chrono::milliseconds call_timeout);

    bool isDynamic() const override { return true; }
    /// At connection: the method's signature must be the partner's, where the partner knows its own.
    std::string bindMethod(Method* required) override;
    ReturnType callService(std::string& name, std::vector<opros_params>& arguments,
                           opros_params& result) override;
    using ProvidedServicePort::callService;

  private:
    const link::Port partner_;
    link::Link& link_;
    const std::chrono::milliseconds call_timeout_;
    std::map<std::string, std::string> signatures_; ///< of bound methods; complete before anybody calls
};

} // namespace tandem::adaptor
