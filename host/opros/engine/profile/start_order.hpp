// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/application_profile.hpp"

namespace tandem::engine {

/// The components' names in the order of their start: the last listed first, as the original engine does, but
/// none before a component it depends on. Stopping takes the reverse. Throws SetupError, at the line of a
/// <depends>, when components depend on each other in a circle.
std::vector<std::string> start_order(const ApplicationProfile& profile);

} // namespace tandem::engine
