// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/execute/worker_pool.hpp"

#include <ProvidedServicePort.h>
#include <RequiredMethodInterface.h>
#include <RequiredServicePort.h>

#include <memory>
#include <vector>

namespace tandem::engine {

/// From a required service port to a provided one: each required method gets the provided one of its name,
/// called in the caller's thread; a method without result that does not block is called by a worker.
class ServiceConnection : public Connection {
  public:
    /// Throws std::runtime_error with the reason when the ports do not fit.
    ServiceConnection(RequiredServicePort& required, ProvidedServicePort& provided, ComponentHost& provider,
                      WorkerPool& workers);
    ~ServiceConnection() override;

  private:
    struct Unconnected {};
    ServiceConnection(RequiredServicePort& required, ProvidedServicePort& provided, ComponentHost& provider,
                      WorkerPool& workers,
                      Unconnected); // what has been connected is undone if the rest does not fit
    void connect();
    void connect_method(const std::string& name, Method& method);
    void connect_through(RequiredMethodInterface& method, std::unique_ptr<ServicePortConnector> connector);

    RequiredServicePort& required_;
    ProvidedServicePort& provided_;
    ComponentHost& provider_;
    WorkerPool& workers_;
    std::vector<RequiredMethodInterface*> connected_;
    std::vector<std::unique_ptr<ServicePortConnector>> connectors_;
    bool bound_ = false;
};

} // namespace tandem::engine
