// SPDX-License-Identifier: Apache-2.0
// ServiceUtils.h defines getVersion() of a component library, which this library is not.
#define MAKE_STATIC_COMPONENT
#include <Component.h>
#include <PackageUtil.h>
#include <ServiceUtils.h>

Component::Component() = default;
Component::Component(const std::string& compId) : m_compId(compId) {}
Component::~Component() = default;
void Component::setId(std::string id) { m_compId = std::move(id); }
std::string Component::getId() { return m_compId; }

// The defaults. Of them onInitialize, onStart, onStop and onDestroy must be overridden: a transition whose
// callback returns anything but OPROS_SUCCESS fails. The host does not count OPROS_UNSUPPORTED_METHOD of onExecute
// and onUpdated as an error.
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
// Values from before a stop are out of date when the component starts again.
void Component::afterStop() { portReset(); }

// The property that the host sets before onInitialize; empty in the constructor.
std::string opros_package_getResPath(Component* comp) {
    return comp->getProperty("_opros_xx_internal_xx_Component_Path");
}

// The version that components compare in getVersion(): that of the OPRoS release whose API this is.
const char* get_opros_version() { return "BRILL-1-0-0-0"; }
