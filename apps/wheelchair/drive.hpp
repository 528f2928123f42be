// SPDX-License-Identifier: Apache-2.0
// The program `wheelchair`.
#pragma once

namespace tandem::wheelchair {

/// Reads the command line, performs the runs, prints the report and writes the files. Returns the program's exit code: 0 if
/// everything is accepted, 1 if not, 130 after an interrupt. [main thread]
int drive(int argc, char** argv);

} // namespace tandem::wheelchair
