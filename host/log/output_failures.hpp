// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::log {

/// From now on a write that fails is an error of that write alone: neither a reader of the log that has gone (SIGPIPE) nor a file that
/// has reached its limit (SIGXFSZ) ends the process. Programs that it starts are not affected. [main-thread]
void outlive_output_failures();

} // namespace tandem::log
