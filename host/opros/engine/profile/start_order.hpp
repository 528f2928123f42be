// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/application_profile.hpp"

namespace tandem::engine {

/// Returns the component names in start order: the last listed first, as in the original engine, but no component
/// before its dependencies. Components stop in reverse order. Throws SetupError with the line of a <depends> if the
/// dependencies form a cycle.
std::vector<std::string> start_order(const ApplicationProfile& profile);

} // namespace tandem::engine
