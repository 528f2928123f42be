// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/application_profile.hpp"

#include <vector>

namespace tandem::engine {

/// Finds connections that are listed several times, so that no value is delivered twice, and second providers of a
/// required port. Of equal connections, the first stays valid, the second gets an error with the number of times it
/// is listed, and the others are removed. Connections that already have the same error are merged into one, with
/// their number in the error: a generated profile may list thousands.
void mark_duplicate_connections(std::vector<ConnectionProfile>& connections);

} // namespace tandem::engine
