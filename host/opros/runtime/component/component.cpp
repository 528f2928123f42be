// SPDX-License-Identifier: Apache-2.0
#define MAKE_STATIC_COMPONENT // this library is no component
#include <Component.h>
#include <PackageUtil.h>
#include <ServiceUtils.h>

Component::Component() = default;
Component::Component(const std::string& compId) : m_compId(compId) {}
Component::~Component() = default;
void Component::setId(std::string id) { m_compId = std::move(id); }
std::string Component::getId() { return m_compId; }

ReturnType Component::onInitialize() { return OPROS_UNSUPPORTED_METHOD; }
ReturnType Component::onStart() { return OPROS_UNSUPPORTED_METHOD; }
ReturnType Component::onStop() { return OPROS_UNSUPPORTED_METHOD; }
ReturnType Component::onReset() { return OPROS_UNSUPPORTED_METHOD; }
ReturnType Component::onError() { return OPROS_UNSUPPORTED_METHOD; }
ReturnType Component::onRecover() { return OPROS_UNSUPPORTED_METHOD; }
ReturnType Component::onDestroy() { return OPROS_UNSUPPORTED_METHOD; }
ReturnType Component::onEvent(Event*) { return OPROS_UNSUPPORTED_METHOD; }
ReturnType Component::onExecute() { return OPROS_UNSUPPORTED_METHOD; }
ReturnType Component::onUpdated() { return OPROS_UNSUPPORTED_METHOD; }
ReturnType Component::onPeriodChanged() { return OPROS_UNSUPPORTED_METHOD; }
void Component::afterStop() { portReset(); }

PropertyInterface::PropertyInterface() = default;
PropertyInterface::~PropertyInterface() = default;
void PropertyInterface::setProperty(const std::string& name, const std::string& value) {
    m_properties[name] = value;
}
std::string& PropertyInterface::getProperty(const std::string& name) {
    const auto found = m_properties.find(name);
    if (found != m_properties.end()) return found->second;
    m_absent.clear();
    return m_absent;
}
std::map<std::string, std::string>& PropertyInterface::getPropertyMap() { return m_properties; }

std::string opros_package_getResPath(Component* comp) {
    return comp->getProperty("_opros_xx_internal_xx_Component_Path");
}

const char* get_opros_version() { return "BRILL-1-0-0-0"; }
