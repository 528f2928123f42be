// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::process {

/// Makes a component's call of exit() safe while other components still run: after the exit handlers and
/// static destructors of libraries loaded later than this object, the process ends by exit_process() with the
/// component's code, and nothing of the host is destroyed. One object at a time. [main-thread]
class ExitGuard {
  public:
    ExitGuard();
    ~ExitGuard();
    ExitGuard(const ExitGuard&) = delete;
    ExitGuard& operator=(const ExitGuard&) = delete;
};

} // namespace tandem::process
