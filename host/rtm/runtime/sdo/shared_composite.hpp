// SPDX-License-Identifier: Apache-2.0
// The component type PeriodicECSharedComposite, whose class is in rtm/PeriodicECSharedComposite.h.
#pragma once

namespace RTC {

class Manager;

/// Registers the component type with the manager; called when the manager starts.
void register_shared_composite(Manager& manager);

} // namespace RTC
