// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::log {

/// Makes failed writes, from now on, errors of the write alone. Neither a reader of the log that has gone (SIGPIPE) nor
/// a file that has reached its limit (SIGXFSZ) ends the process. Programs that the process starts are not affected.
/// [main-thread]
void outlive_output_failures();

/// Occupies the numbers of standard input, output and error if they are closed, so that no other file gets them. A file
/// opened by the program would otherwise receive its messages. Writes still fail. Call it first in main(). [main-thread]
void hold_standard_streams();

} // namespace tandem::log
