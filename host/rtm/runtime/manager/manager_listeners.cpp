// SPDX-License-Identifier: Apache-2.0
// Registration of listeners of the manager, as in OpenRTM-aist's ManagerActionListener.h. The holder of each
// kind has its own mutex, so a listener may be added or removed by any thread; `autoclean` hands it over.
#include "host/rtm/runtime/manager/manager_impl.hpp"

namespace RTC {

void Manager::addManagerActionListener(RTM::ManagerActionListener* listener, bool autoclean) {
    m_impl->listeners.manager_.addListener(listener, autoclean);
}
void Manager::removeManagerActionListener(RTM::ManagerActionListener* listener) {
    m_impl->listeners.manager_.removeListener(listener);
}
void Manager::addModuleActionListener(RTM::ModuleActionListener* listener, bool autoclean) {
    m_impl->listeners.module_.addListener(listener, autoclean);
}
void Manager::removeModuleActionListener(RTM::ModuleActionListener* listener) {
    m_impl->listeners.module_.removeListener(listener);
}
void Manager::addRtcLifecycleActionListener(RTM::RtcLifecycleActionListener* listener, bool autoclean) {
    m_impl->listeners.rtclifecycle_.addListener(listener, autoclean);
}
void Manager::removeRtcLifecycleActionListener(RTM::RtcLifecycleActionListener* listener) {
    m_impl->listeners.rtclifecycle_.removeListener(listener);
}
void Manager::addNamingActionListener(RTM::NamingActionListener* listener, bool autoclean) {
    m_impl->listeners.naming_.addListener(listener, autoclean);
}
void Manager::removeNamingActionListener(RTM::NamingActionListener* listener) {
    m_impl->listeners.naming_.removeListener(listener);
}

} // namespace RTC
