// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::command {

/// Asks on the terminal whether to install the Debian package, and installs it with apt-get, for users other than root through
/// sudo. Returns whether it did; false without asking if standard input or standard error is not a terminal, or if the user has
/// refused the package before.
bool offer_package(const std::string& package);

} // namespace tandem::command
