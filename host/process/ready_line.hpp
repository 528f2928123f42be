// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::process {

/// Writes the line by which supervisors and tests know that a host is ready. For a supervisor that has set TANDEM_SUPERVISED in
/// the environment it begins with a newline, in the same write, so that it is a line of its own behind a component's prompt.
void write_ready_line(const std::string& line);

} // namespace tandem::process
