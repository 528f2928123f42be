// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::process {

/// Writes the line by which supervisors and tests know that a host is ready. If a supervisor has set TANDEM_SUPERVISED
/// in the environment, the same write begins with a newline. The line is then separate from a prompt that a component
/// has printed.
void write_ready_line(const std::string& line);

} // namespace tandem::process
