// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/src/profile.hpp"

#include <vector>

namespace tandem::engine {

/// Gives an error to the second of connections between the same ports, and to connections of a required port
/// that has its provider already; a third and later ones are taken off the list, the second tells how many.
void mark_repeated(std::vector<Connection>& connections);

} // namespace tandem::engine
