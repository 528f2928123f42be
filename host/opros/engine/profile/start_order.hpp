// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/profile.hpp"

namespace tandem::engine {

/// The components' names in the order of their start: the last listed first, but none before one it depends
/// on. Throws SetupError when components depend on each other in a circle.
std::vector<std::string> start_order(const ApplicationProfile& profile);

} // namespace tandem::engine
