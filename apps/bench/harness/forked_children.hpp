// SPDX-License-Identifier: Apache-2.0
// Child processes that run a function of this program. A case forks instead of starting a program, so that its
// sides inherit the anonymous shared memory and the calibrated clock.
#pragma once
#include "host/process/child_process.hpp"

#include <string>
#include <vector>

namespace tandem::bench {

/// Forks: 0 in the child, its pid in the parent. The child has default actions for SIGINT and SIGTERM and is
/// killed when its parent dies. Throws std::system_error.
pid_t fork_child();

/// [driver] The children of one case; those that still run are killed when it is destroyed.
class ForkedChildren {
  public:
    /// Runs work(), which must end the process, in a new child.
    template <class Work>
    void start(Work&& work) {
        const pid_t child = fork_child();
        if (child == 0) work();
        children_.emplace_back(child);
    }

    /// Of the child that was started last.
    pid_t last_pid() const { return children_.back().pid(); }

    /// Waits until all have ended, at most `seconds`. Returns the first failure (an exit code other than 0, a
    /// signal, the timeout, an interrupt) in one line, or an empty string.
    std::string wait(double seconds);

  private:
    std::vector<process::ChildProcess> children_; // A, then B
};

/// [driver] From here on SIGINT and SIGTERM end the case that runs instead of the program.
void catch_interrupts();
/// True once one of the two has come.
bool interrupted();

} // namespace tandem::bench
