// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::log {

/// Makes failed writes, from now on, errors of the write alone. Neither a reader of the log that has gone (SIGPIPE) nor
/// a file that has reached its limit (SIGXFSZ) ends the process. Programs that the process starts are not affected.
/// [main-thread]
void outlive_output_failures();

} // namespace tandem::log
