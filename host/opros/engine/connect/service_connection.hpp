// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/opros/engine/execute/component_host.hpp"

#include <ProvidedServicePort.h>
#include <RequiredMethodInterface.h>
#include <RequiredServicePort.h>

#include <memory>
#include <vector>

namespace tandem::engine {

/// From a required service port to a provided one: each required method is bound to the provided method of its
/// name. A call runs in the caller's thread, as a function call; a non-blocking method without a result goes
/// through the provider's task queue. Ports that learn their methods at connection (isDynamic()) are asked first.
class ServiceConnection : public Connection {
  public:
    /// Throws std::runtime_error with the reason when a method is missing or has another signature, or a dynamic port
    /// refuses all methods; methods that were bound before are unbound again.
    ServiceConnection(RequiredServicePort& required, ProvidedServicePort& provided, ComponentHost& provider);
    ~ServiceConnection() override { ServiceConnection::disconnect(); }
    /// A method that is called then throws; a call under way ends as it would have.
    bool disconnect() override;
    /// Why a dynamic port refused some of the methods, one line each: it throws when they are called.
    const std::vector<std::string>& refusals() const { return refusals_; }

  private:
    struct Unconnected {};
    /// Delegated to by the other constructor: when the rest of that one throws, the destructor runs.
    ServiceConnection(RequiredServicePort& required, ProvidedServicePort& provided, ComponentHost& provider,
                      Unconnected);
    void connect();
    void connect_method(const std::string& name, Method& method);
    void connect_through(RequiredMethodInterface& method, std::unique_ptr<ServicePortConnector> connector);

    RequiredServicePort& required_;
    ProvidedServicePort& provided_;
    ComponentHost& provider_;
    std::vector<RequiredMethodInterface*> connected_; // to be disconnected at the end
    std::vector<std::unique_ptr<ServicePortConnector>> connectors_;
    std::vector<std::string> refusals_;
    bool bound_ = false; // the dynamic required port has accepted the provided one
};

} // namespace tandem::engine
