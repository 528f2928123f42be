// SPDX-License-Identifier: Apache-2.0
// Ends of a host at which threads of components are still running.
#pragma once

#include <chrono>
#include <string>

namespace tandem::rt {

/// [any-thread] Writes what files and standard output have buffered. No lock of a stream is waited for: a
/// thread that reads stdin holds one for ever.
void flush_streams();

/// [any-thread] Flushes, within two seconds, and ends the process with `code`. No static object is destroyed
/// under the feet of threads that have not come back.
[[noreturn]] void leave(int code);

/// [main-thread] To be called before main() returns, while libraries of components are still loaded: when
/// their static destructors take longer than `grace`, the process says `line` on standard error and ends with
/// code 1.
void bound_exit(std::chrono::nanoseconds grace, std::string line);

/// [main-thread] While it lives a component may call exit(): what libraries loaded after this have left for
/// the exit is done, then the host leaves with the component's code. One at a time.
class SuddenExit {
  public:
    SuddenExit();
    ~SuddenExit();
    SuddenExit(const SuddenExit&) = delete;
    SuddenExit& operator=(const SuddenExit&) = delete;
};

} // namespace tandem::rt
