// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/opros/engine/connect/reported_port.hpp"
#include "host/opros/engine/execute/component_host.hpp"

#include <ProvidedServicePort.h>
#include <RequiredMethodInterface.h>
#include <RequiredServicePort.h>

#include <memory>
#include <vector>

namespace tandem::engine {

/// Connects a required service port to a provided one: binds each required method to the provided method of the same
/// name. A call is a function call in the caller's thread. A non-blocking method without a result goes through the
/// provider's task queue. Ports that learn their methods when they are connected (isDynamic()) are asked first.
class ServiceConnection : public Connection {
  public:
    /// Throws std::runtime_error with the reason if a method is missing or has another signature, or if a dynamic port
    /// refuses all methods. Methods that are already bound are then unbound again.
    ServiceConnection(RequiredServicePort& required, ProvidedServicePort& provided, ComponentHost& provider);
    ~ServiceConnection() override { ServiceConnection::disconnect(); }
    /// Ends the connection: later calls of a method throw, and a call in progress ends normally. Returns true.
    bool disconnect() override;
    /// Returns, one line each, why a dynamic port refused some of the methods. Calls of these methods throw.
    const std::vector<std::string>& refusals() const { return refusals_; }

  private:
    struct Unconnected {};
    /// The other constructor delegates to this one, so that the destructor runs if the rest of the other one throws.
    ServiceConnection(RequiredServicePort& required, ProvidedServicePort& provided, ComponentHost& provider,
                      Unconnected);
    void connect();
    void connect_method(const std::string& name, Method& method);
    void connect_through(RequiredMethodInterface& method, std::unique_ptr<ServicePortConnector> connector);

    RequiredServicePort& required_;
    ProvidedServicePort& provided_;
    ComponentHost& provider_;
    std::vector<RequiredMethodInterface*> connected_; // disconnected at the end
    std::vector<std::unique_ptr<ServicePortConnector>> connectors_;
    std::vector<std::string> refusals_;
    std::unique_ptr<ReportedPort> reported_; // bound in place of provided_; null: is dynamic, too
    bool bound_ = false;                     // the dynamic required port has accepted the provided one
};

} // namespace tandem::engine
