// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::crash {

/// From now on a signal that stands for a fault of the program (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT), and an
/// exception that nobody catches, is reported in one block on standard error before it ends the process as before:
/// component, callback, plugin, signal, address, symbol, and the calls of the thread. `program` is the first word
/// of the block; it must live as long as the process. [main-thread]
void install_crash_report(const char* program);

} // namespace tandem::crash
