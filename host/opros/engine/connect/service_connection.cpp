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

} // namespace

ServiceConnection::ServiceConnection(RequiredServicePort& required, ProvidedServicePort& provided,
                                     ComponentHost& provider, Unconnected)
    : required_(required), provided_(provided), provider_(provider) {}

ServiceConnection::ServiceConnection(RequiredServicePort& required, ProvidedServicePort& provided,
                                     ComponentHost& provider)
    : ServiceConnection(required, provided, provider, Unconnected{}) {
    connect();
}

bool ServiceConnection::disconnect() {
    for (RequiredMethodInterface* method : connected_) method->Disconnect();
    connected_.clear();
    if (bound_) required_.bindProvided(nullptr);
    bound_ = false;
    return true;
}

void ServiceConnection::connect() {
    if (required_.isDynamic()) {
        if (!provided_.isDynamic()) reported_ = std::make_unique<ReportedPort>(provided_, provider_);
        const std::string refusal = required_.bindProvided(reported_ ? reported_.get() : &provided_);
        if (!refusal.empty()) throw std::runtime_error(refusal);
        bound_ = true;
        return;
    }
    for (auto it = required_.getFirst(); it != required_.getEnd(); ++it)
        connect_method(it->first, *it->second);
    if (!connected_.empty() && refusals_.size() == connected_.size())
        throw std::runtime_error(refusals_.front());
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
    // Set before connecting, so that the destructor also undoes a connection that fails half-way.
    connected_.push_back(required);
    if (provided_.isDynamic()) {
        const std::string refusal = provided_.bindMethod(&method);
        if (!refusal.empty()) refusals_.push_back(refusal);
        return connect_through(*required, make_direct_connector(provided_, provider_));
    }
    Method* peer = provided_.getMethod(name);
    if (!peer)
        throw std::runtime_error("the provided port has no method '" + name + "', it has " +
                                 method_names(provided_));
    // The caller would have to wait for a result, so a non-blocking method with a result is called like any other
    // method.
    if (method.getCallType() == METHOD_NONBLOCKING && peer->getReturnType() == "void")
        return connect_through(*required, make_queued_connector(provided_, provider_));
    if (required->Connect(peer) != OPROS_SUCCESS)
        throw std::runtime_error("type mismatch of method " + name + ": required is " + method.signature() +
                                 ", provided is " + peer->signature());
}

} // namespace tandem::engine
