// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/observe/link_follower.hpp"

namespace tandem::command {

/// A follower of that link, with its ports. Throws std::runtime_error in one line if there is no such link, or no such port
/// in it; the message names the ports that there are.
LinkFollower open_link(const std::string& link, const std::vector<std::string>& ports);

/// Sleeps as long as a reader of messages may between two looks: 1 ms.
void sleep_between_looks();

} // namespace tandem::command
