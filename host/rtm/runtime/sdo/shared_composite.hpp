// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace RTC {

class Manager;

/// Makes the component type PeriodicECSharedComposite known.
void register_shared_composite(Manager& manager);

} // namespace RTC
