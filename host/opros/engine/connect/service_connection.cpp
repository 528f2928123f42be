// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/connect/service_connection.hpp"

#include "host/opros/engine/connect/service_connector.hpp"

#include <stdexcept>

namespace tandem::engine {
namespace {

std::string method_names(ServicePortInterface& port) {
    std::string names;
    for (auto it = port.getFirst(); it != port.getEnd(); ++it)
        names += (names.empty() ? "" : ", ") + it->first;
    return names.empty() ? "no methods" : names;
}

void refuse_if(const std::string& text) {
    if (!text.empty()) throw std::runtime_error(text);
}

} // namespace

ServiceConnection::ServiceConnection(RequiredServicePort& required, ProvidedServicePort& provided,
                                     ComponentHost& provider, WorkerPool& workers, Unconnected)
    : required_(required), provided_(provided), provider_(provider), workers_(workers) {}

ServiceConnection::ServiceConnection(RequiredServicePort& required, ProvidedServicePort& provided,
                                     ComponentHost& provider, WorkerPool& workers)
    : ServiceConnection(required, provided, provider, workers, Unconnected{}) {
    connect();
}

ServiceConnection::~ServiceConnection() {
    for (RequiredMethodInterface* method : connected_) method->Disconnect();
    if (bound_) required_.bindProvided(nullptr);
}

void ServiceConnection::connect() {
    if (required_.isDynamic()) {
        refuse_if(required_.bindProvided(&provided_));
        bound_ = true;
        return;
    }
    for (auto it = required_.getFirst(); it != required_.getEnd(); ++it)
        connect_method(it->first, *it->second);
}

void ServiceConnection::connect_through(RequiredMethodInterface& method,
                                        std::unique_ptr<ServicePortConnector> connector) {
    method.Connect(connector.get());
    connectors_.push_back(std::move(connector));
}

void ServiceConnection::connect_method(const std::string& name, Method& method) {
    auto* required = dynamic_cast<RequiredMethodInterface*>(&method);
    if (!required)
        throw std::runtime_error("method " + name + " of the required port is not a required method");
    connected_.push_back(required);
    if (provided_.isDynamic()) {
        refuse_if(provided_.bindMethod(&method));
        return connect_through(*required, make_direct_connector(provided_, provider_));
    }
    Method* peer = provided_.getMethod(name);
    if (!peer)
        throw std::runtime_error("the provided port has no method '" + name + "', it has " +
                                 method_names(provided_));
    if (method.getCallType() == METHOD_NONBLOCKING && peer->getReturnType() == "void")
        return connect_through(*required,
                               make_queued_connector(provided_, provider_, workers_.of(&provider_)));
    if (required->Connect(peer) != OPROS_SUCCESS)
        throw std::runtime_error("type mismatch of method " + name + ": required is " + method.signature() +
                                 ", provided is " + peer->signature());
}

} // namespace tandem::engine
