// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/description/component_description.hpp"

#include "proxy/adaptor/archive/type_check.hpp"

#include <Component.h>
#include <InputDataPortInterface.h>
#include <InputEventPortInterface.h>
#include <ProvidedServicePort.h>

namespace tandem::command {
namespace {

using nlohmann::json;

// The signature is that of the compiled C++ function.
json describe_methods(ServicePortInterface& port) {
    json methods = json::array();
    for (auto each = port.getFirst(); each != port.getEnd(); ++each)
        methods.push_back(
            {{"name", each->first},
             {"signature", each->second->signature()},
             {"call", each->second->getCallType() == METHOD_NONBLOCKING ? "nonblocking" : "blocking"}});
    return methods;
}

// Returns null if the type cannot cross a link, or if its own load() rejects a trial's values.
json signature_of(const opros_any& sample) {
    try {
        return wire::to_signature(adaptor::type_of(sample, {}));
    } catch (const std::exception&) {
        return nullptr;
    }
}

// A port's type is the type of its sample value. The value is empty in ports that carry any type.
json describe_typed_port(Port& port, const char* kind, bool input) {
    const opros_any sample = port.sample();
    json out{{"kind", kind}, {"direction", input ? "input" : "output"}};
    out["type"] = sample.empty() ? json() : json(sample.type());
    if (sample.serializable()) out["signature"] = signature_of(sample);
    return out;
}

// The API returns the kind of a port, but only its class shows the direction.
json describe_port(Port& port, PortType kind) {
    if (kind == OPROS_DATA)
        return describe_typed_port(port, "data", dynamic_cast<InputDataPortInterface*>(&port));
    if (kind == OPROS_EVENT)
        return describe_typed_port(port, "event", dynamic_cast<InputEventPortInterface*>(&port));
    json out{{"kind", "service"},
             {"direction", dynamic_cast<ProvidedServicePort*>(&port) ? "provided" : "required"}};
    if (auto* service = dynamic_cast<ServicePortInterface*>(&port))
        out["methods"] = describe_methods(*service);
    return out;
}

} // namespace

json describe_component(Component& component) {
    json ports = json::array();
    for (const PortType kind : {OPROS_DATA, OPROS_EVENT, OPROS_SERVICE})
        for (const std::string& name : component.getPortNames(kind)) {
            json port = describe_port(*component.getPort(name), kind);
            port["name"] = name;
            ports.push_back(std::move(port));
        }
    return {{"properties", component.getPropertyMap()}, {"ports", std::move(ports)}};
}

} // namespace tandem::command
