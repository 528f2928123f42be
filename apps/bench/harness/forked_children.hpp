// SPDX-License-Identifier: Apache-2.0
// Child processes that run a function of this program. A case forks instead of starting a program, so that its
// sides inherit the anonymous shared memory and the calibrated clock.
#pragma once
#include "host/process/child_process.hpp"

#include <string>
#include <vector>

namespace tandem::bench {

/// Forks. Returns 0 in the child, and the child's pid in the parent. The child has default actions for SIGINT
/// and SIGTERM and is killed when its parent dies. Throws std::system_error.
pid_t fork_child();

/// [driver] The children of one case. The destructor kills those that still run.
class ForkedChildren {
  public:
    /// Runs work(), which must end the process, in a new child.
    template <class Work>
    void start(Work&& work) {
        const pid_t child = fork_child();
        if (child == 0) work();
        children_.emplace_back(child);
    }

    /// Returns the pid of the child that was started last.
    pid_t last_pid() const { return children_.back().pid(); }

    /// Waits until all children have ended, for at most `seconds`. Returns the first failure (an exit code
    /// other than 0, a signal, the timeout, an interrupt) in one line, or an empty string.
    std::string wait(double seconds);

  private:
    std::vector<process::ChildProcess> children_; // A, then B
};

/// [driver] From here on, SIGINT and SIGTERM end the running case instead of the program.
void catch_interrupts();
/// Returns true once one of the two signals has arrived.
bool interrupted();

} // namespace tandem::bench
