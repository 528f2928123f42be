// SPDX-License-Identifier: Apache-2.0
#include "host/opros/control/describe_port.hpp"

#include <InputDataPortInterface.h>
#include <InputEventPortInterface.h>
#include <ProvidedServicePort.h>

namespace tandem::control {
namespace {

using nlohmann::json;

json describe_methods(ServicePortInterface& port) {
    json methods = json::array();
    for (auto each = port.getFirst(); each != port.getEnd(); ++each)
        methods.push_back(
            {{"name", each->first},
             {"signature", each->second->signature()},
             {"call", each->second->getCallType() == METHOD_NONBLOCKING ? "nonblocking" : "blocking"}});
    return methods;
}

// Only the class of a port shows its direction.
const char* direction_of(Port& port) {
    if (port.getType() == OPROS_SERVICE)
        return dynamic_cast<ProvidedServicePort*>(&port) != nullptr ? "provided" : "required";
    const bool is_input = dynamic_cast<InputDataPortInterface*>(&port) != nullptr ||
                          dynamic_cast<InputEventPortInterface*>(&port) != nullptr;
    return is_input ? "input" : "output";
}

// A port's type is the type of its sample value. The value is empty in ports that carry any type.
json type_of(Port& port) {
    const opros_any sample = port.sample();
    return sample.empty() ? json() : json(sample.type());
}

} // namespace

const char* kind_name(PortType type) {
    if (type == OPROS_EVENT) return "event";
    return type == OPROS_SERVICE ? "service" : "data";
}

json describe_port(Port& port) {
    json out{{"kind", kind_name(port.getType())}, {"direction", direction_of(port)}};
    auto* service = dynamic_cast<ServicePortInterface*>(&port);
    out["type"] = service != nullptr ? json() : type_of(port);
    if (service != nullptr) out["methods"] = describe_methods(*service);
    return out;
}

} // namespace tandem::control
