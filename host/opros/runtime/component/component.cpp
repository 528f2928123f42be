// SPDX-License-Identifier: Apache-2.0
// ServiceUtils.h defines getVersion() for component libraries. This library is not one.
#define MAKE_STATIC_COMPONENT
#include <Component.h>
#include <PackageUtil.h>
#include <ServiceUtils.h>

Component::Component() = default;
Component::Component(const std::string& compId) : m_compId(compId) {}
Component::~Component() = default;
void Component::setId(std::string id) { m_compId = std::move(id); }
std::string Component::getId() { return m_compId; }

// Defaults. A component must override onInitialize, onStart, onStop and onDestroy: a transition fails unless its
// callback returns OPROS_SUCCESS. OPROS_UNSUPPORTED_METHOD from onExecute and onUpdated is not an error for the host.
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
// Values from before a stop are outdated when the component starts again.
void Component::afterStop() { portReset(); }

// The host sets this property before onInitialize. In the component's constructor it is still empty.
std::string opros_package_getResPath(Component* comp) {
    return comp->getProperty("_opros_xx_internal_xx_Component_Path");
}

// Components compare this version in getVersion(). It is the OPRoS release whose API this library implements.
const char* get_opros_version() { return "BRILL-1-0-0-0"; }
