// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::process {

/// Makes it safe for a component to call exit() while other components still run. First the exit handlers and static
/// destructors of libraries run that were loaded later than this object was created. Then exit_process() ends the
/// process with the component's code, and no object of the host is destroyed. At most one object may exist at a time.
/// [main-thread]
class ExitGuard {
  public:
    ExitGuard();
    ~ExitGuard();
    ExitGuard(const ExitGuard&) = delete;
    ExitGuard& operator=(const ExitGuard&) = delete;
};

} // namespace tandem::process
