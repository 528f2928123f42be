// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <rtm/RTObject.h>

namespace RTC {

/// Gives a component that has its instance name, but is not initialized yet, its properties and names.
/// Precedence from low to high: `profile` of its type, what rtc.conf says for all components, the files and
/// settings of its type and of its instance, the arguments of its creation. Throws ManagerError for a
/// configuration file with an error. Returns the settings that are this component's own, from its files and arguments.
coil::Properties configure_component(Manager::Impl& impl, RTObject_impl& component,
                                     const coil::Properties& profile, const coil::Properties& arguments);

} // namespace RTC
