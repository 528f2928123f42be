// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/link.hpp"

#include <ProvidedServicePort.h>

#include <chrono>
#include <map>
#include <string>

namespace tandem::adaptor {

/// Mirrors a service port that the peer provides: a call of an OPRoS component crosses the link in the calling
/// thread and waits for the reply, at most `call_timeout`. A failure is thrown as MethodInvokeException, one
/// line. The arguments are encoded by the component's own serialization; no stub is compiled.
class MirrorProvidedPort final : public ProvidedServicePort {
  public:
    MirrorProvidedPort(link::Port peer, link::Link& link, std::chrono::milliseconds call_timeout);

    bool isDynamic() const override { return true; }
    /// Called when the host connects this port, once for each method of the required port. Returns an empty
    /// string, or one line if the peer has no operation of that name and signature.
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
