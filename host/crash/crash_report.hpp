// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::crash {

/// Installs handlers that report a crash of the program in one block on standard error. A crash is a fault signal
/// (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) or an uncaught exception. It still ends the process as before. The
/// block names `program`, component, callback, plugin, signal, address, symbol and the thread's calls. Before it, and
/// before any other core dump, the process gives up its locks. `program` must stay valid. [main-thread]
void install_crash_report(const char* program);

} // namespace tandem::crash
