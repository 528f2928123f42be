// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/description.hpp"

#include <Component.h>
#include <InputDataPortInterface.h>
#include <InputEventPortInterface.h>
#include <ProvidedServicePort.h>

namespace tandem::command {
namespace {

using nlohmann::json;

json methods_of(ServicePortInterface& port) {
    json methods = json::array();
    for (auto each = port.getFirst(); each != port.getEnd(); ++each)
        methods.push_back(
            {{"name", each->first},
             {"signature", each->second->signature()},
             {"call", each->second->getCallType() == METHOD_NONBLOCKING ? "nonblocking" : "blocking"}});
    return methods;
}

json typed(Port& port, const char* kind, bool input) {
    const opros_any sample = port.sample();
    json out{{"kind", kind}, {"direction", input ? "input" : "output"}};
    out["type"] = sample.empty() ? json() : json(sample.type());
    return out;
}

json port_of(Port& port, PortType kind) {
    if (kind == OPROS_DATA) return typed(port, "data", dynamic_cast<InputDataPortInterface*>(&port));
    if (kind == OPROS_EVENT) return typed(port, "event", dynamic_cast<InputEventPortInterface*>(&port));
    json out{{"kind", "service"},
             {"direction", dynamic_cast<ProvidedServicePort*>(&port) ? "provided" : "required"}};
    if (auto* service = dynamic_cast<ServicePortInterface*>(&port)) out["methods"] = methods_of(*service);
    return out;
}

} // namespace

json describe(Component& component) {
    json ports = json::array();
    for (const PortType kind : {OPROS_DATA, OPROS_EVENT, OPROS_SERVICE})
        for (const std::string& name : component.getPortNames(kind)) {
            json port = port_of(*component.getPort(name), kind);
            port["name"] = name;
            ports.push_back(std::move(port));
        }
    return {{"properties", component.getPropertyMap()}, {"ports", std::move(ports)}};
}

} // namespace tandem::command
