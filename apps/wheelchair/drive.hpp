// SPDX-License-Identifier: Apache-2.0
// The program `wheelchair`.
#pragma once

namespace tandem::wheelchair {

/// Parses the command line, performs the runs, prints the report and writes the files. Returns the exit code: 0 if all
/// checks pass, 1 if not, 130 after an interrupt. [main thread]
int drive(int argc, char** argv);

} // namespace tandem::wheelchair
