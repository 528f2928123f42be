// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <coil/Properties.h>
#include <rtm/idl/ManagerSkel.h>
#include <string>
#include <vector>

namespace RTC {

/// How a callback that has taken so long is spoken of, from this time on.
constexpr double hanging_after_s = 16;
constexpr const char* hanging_text = "; it hangs, or waits for something";

/// A component that is between its constructor and the end of its initialize(): no list of components has it yet.
struct ComponentCreation {
    std::string instance, type;
    std::string callback; ///< that it is in; empty: none
    double seconds = 0;   ///< since its initialize() has begun

    bool hangs() const { return seconds >= hanging_after_s; }
    /// `onInitialize has taken 3.1 s so far`, and whether it hangs.
    std::string text() const;
};

/// What the profile of a manager says of creations, beside OpenRTM-aist's `manager.*`: `creating.0.instance_name` ...
coil::Properties to_properties(const std::vector<ComponentCreation>& creations);
/// Of another process's manager; none if it is one of OpenRTM-aist, which does not say. Throws CORBA::SystemException.
std::vector<ComponentCreation> components_being_created(RTM::Manager_ptr manager);

} // namespace RTC
