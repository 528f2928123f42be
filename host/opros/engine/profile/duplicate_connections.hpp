// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/application_profile.hpp"

#include <vector>

namespace tandem::engine {

/// Finds connections that are listed several times, so that no value is delivered twice, and second providers
/// of one required port. The first of equal connections stays good, the second gets an error that says how
/// often it is listed, the others are removed. Connections that have the same error already become one, with
/// their number in the error: a generated profile may list thousands.
void mark_duplicate_connections(std::vector<ConnectionProfile>& connections);

} // namespace tandem::engine
