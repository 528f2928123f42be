// SPDX-License-Identifier: Apache-2.0
#include <MethodInvokeException.h>
#include <ProvidedMethodInterface.h>
#include <ProvidedServicePort.h>
#include <RequiredServicePort.h>

Method::Method() = default;
Method::Method(const std::string& name) : m_name(name) {}
Method::~Method() = default;
std::string& Method::getName() { return m_name; }
// Defaults for methods that components derive themselves: their types are unknown.
bool Method::describe(MethodDescription&) { return false; }
std::vector<const std::type_info*> Method::types() const { return {}; }

std::string Method::signature() {
    // Without the C++ types, only what generated code provides: the result's name and the number of arguments.
    const auto known = types();
    if (known.empty()) return getReturnType() + " (" + std::to_string(getArity()) + " arguments)";
    std::string text = opros::readable_name(*known[0]) + " (";
    for (std::size_t i = 1; i < known.size(); ++i)
        text += (i > 1 ? ", " : "") + opros::readable_name(*known[i]);
    return text + ")";
}

void Method::refuse_types() {
    throw MethodInvokeException("call of " + m_name + " with other types than it has: " + signature());
}
void Method::refuse_call(ReturnType code) {
    throw MethodInvokeException("call of " + m_name + " failed with code " + std::to_string(code));
}

ServicePortInterface::ServicePortInterface() = default;
ServicePortInterface::ServicePortInterface(const std::string& name) : ServicePort(name) {}
ServicePortInterface::~ServicePortInterface() {
    for (auto& [name, method] : m_methods) delete method;
}
ServicePortInterface::service_base::iterator ServicePortInterface::getFirst() { return m_methods.begin(); }
ServicePortInterface::service_base::iterator ServicePortInterface::getEnd() { return m_methods.end(); }

ReturnType ServicePortInterface::addMethod(const std::string& name, Method* srv) {
    if (!srv) return OPROS_BAD_INPUT_PARAMETER;
    // The port owns its methods. A replaced method is deleted, unless it is the same object.
    Method*& slot = m_methods[name];
    if (slot != srv) delete slot;
    slot = srv;
    return OPROS_SUCCESS;
}

Method* ServicePortInterface::getMethod(const std::string& name) {
    const auto found = m_methods.find(name);
    return found == m_methods.end() ? nullptr : found->second;
}

ProvidedServicePort::ProvidedServicePort() = default;
ProvidedServicePort::ProvidedServicePort(const std::string& name) : ServicePortInterface(name) {}
ProvidedServicePort::~ProvidedServicePort() = default;
ServicePortRole ProvidedServicePort::getRole() { return OPROS_SERVICE_PORT_PROVIDED; }
std::string ProvidedServicePort::bindMethod(Method*) { return ""; }
ReturnType ProvidedServicePort::callEncoded(Method&, const CallValue*, int, const CallValue&) {
    return OPROS_UNSUPPORTED_METHOD;
}

namespace {

// Returns NULL for a method that cannot be called: users may add any Method to a provided port.
ProvidedMethodInterface* as_provided(Method* method) { return method ? method->provided() : nullptr; }

} // namespace

ReturnType ProvidedServicePort::callService(std::string& name, opros::archive::iarchive& in,
                                            opros::archive::oarchive& out) {
    auto* method = as_provided(getMethod(name));
    return method ? method->call(in, out) : OPROS_UNSUPPORTED_METHOD;
}

ReturnType ProvidedServicePort::callService(const std::string& name, EncodedCall& call) {
    auto* method = as_provided(getMethod(name));
    return method ? method->call(call) : OPROS_UNSUPPORTED_METHOD;
}

ReturnType ProvidedServicePort::callService(std::string& name, std::vector<opros_params>& params,
                                            opros_params& result) {
    auto* method = as_provided(getMethod(name));
    return method ? method->call(params, result) : OPROS_UNSUPPORTED_METHOD;
}

RequiredServicePort::RequiredServicePort() = default;
RequiredServicePort::RequiredServicePort(const std::string& name) : ServicePortInterface(name) {}
RequiredServicePort::~RequiredServicePort() = default;
ServicePortRole RequiredServicePort::getRole() { return OPROS_SERVICE_PORT_REQUIRED; }
std::string RequiredServicePort::bindProvided(ProvidedServicePort*) { return ""; }
