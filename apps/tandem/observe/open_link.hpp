// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/observe/link_follower.hpp"

namespace tandem::command {

/// Returns a follower of that link with its ports. Throws std::runtime_error if the link or port does not
/// exist; the one-line message names the existing ports.
LinkFollower open_link(const std::string& link, const std::vector<std::string>& ports);

/// Sleeps for 1 ms, the pause of a message reader between two polls.
void sleep_between_looks();

} // namespace tandem::command
