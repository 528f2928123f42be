// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/profile.hpp"

#include <vector>

namespace tandem::engine {

/// Gives an error to the second of connections between the same ports, and to connections of a required port
/// that has its provider already; a third and later ones are taken off the list, the second tells how many.
/// Of those that have an error already, the first tells how many there are of it.
void mark_duplicate_connections(std::vector<ConnectionProfile>& connections);

} // namespace tandem::engine
