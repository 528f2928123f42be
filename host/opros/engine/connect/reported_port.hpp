// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/execute/component_host.hpp"

#include <ProvidedServicePort.h>

namespace tandem::engine {

/// A provided port whose calls are named by crash reports: with component, port and method. For callers that run no
/// component, as the threads of a bridge that execute the calls of another process. The port and the provider must
/// outlive this object.
class ReportedPort final : public ProvidedServicePort {
  public:
    ReportedPort(ProvidedServicePort& port, ComponentHost& provider);

    ReturnType callService(const std::string& name, EncodedCall& call) override;

  private:
    using ProvidedServicePort::callService;
    ProvidedServicePort& port_;
    ComponentHost& provider_;
};

} // namespace tandem::engine
