// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/names/peer_names.hpp"
#include "proxy/adaptor/typed/method_type.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/protocol/operation_table.hpp"

#include <ProvidedServicePort.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Mirrors a service port that the peer provides, for an engine with only the public API. Has a method for each operation
/// whose types are among the method types, and logs a line for each other operation. A call crosses the link in the calling
/// thread and waits for the reply, at most `call_timeout`. A failure is thrown as MethodInvokeException, one line.
class TypedProvidedPort final : public ProvidedServicePort {
  public:
    TypedProvidedPort(const link::Port& peer, link::Link& link, std::chrono::milliseconds call_timeout,
                      const PeerNames& names = {});

    /// Called by the engine for calls without a result that do not wait. The arguments may have any type that crosses.
    ReturnType callService(std::string& name, std::vector<opros_params>& arguments,
                           opros_params& result) override;
    using ProvidedServicePort::callService;

  private:
    class Operation;
    void add(const link::Port& peer, const link::KnownOperation& known, const PeerNames& names);

    link::Link& link_;
    const std::chrono::milliseconds call_timeout_;
    std::map<std::string, std::unique_ptr<Operation>> operations_; ///< by the names of the methods
};

} // namespace tandem::adaptor
