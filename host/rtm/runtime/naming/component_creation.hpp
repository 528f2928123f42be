// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <coil/Properties.h>
#include <rtm/idl/ManagerSkel.h>
#include <string>
#include <vector>

namespace RTC {

/// The time after which messages say that a callback hangs.
constexpr double hanging_after_s = 16;
constexpr const char* hanging_text = "; it hangs, or waits for something";

/// A component between its constructor and the end of its initialize(). No list of components contains it yet.
struct ComponentCreation {
    std::string instance, type;
    std::string callback; ///< the current callback; empty: none
    double seconds = 0;   ///< since the start of its initialize()

    bool hangs() const { return seconds >= hanging_after_s; }
    /// Returns for example `onInitialize has taken 3.1 s so far`, and whether it hangs.
    std::string text() const;
};

/// Returns the properties of a manager's profile that describe creations, in addition to OpenRTM-aist's
/// `manager.*`: `creating.0.instance_name` ...
coil::Properties to_properties(const std::vector<ComponentCreation>& creations);
/// Asks another process's manager. A manager of OpenRTM-aist reports none. Throws CORBA::SystemException.
std::vector<ComponentCreation> components_being_created(RTM::Manager_ptr manager);

} // namespace RTC
