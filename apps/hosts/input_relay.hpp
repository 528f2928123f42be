// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/child_process.hpp"

#include <vector>

namespace tandem::hosts {

/// Passes what a descriptor has, usually the terminal, on to several child processes: they have process groups of their own,
/// which a terminal stops when they read it themselves. Each gets everything; its input ends when the source's does.
class InputRelay {
  public:
    /// From here on SIGTTIN is ignored: this program may be started in the background, too.
    explicit InputRelay(int source);

    /// For poll(); -1 when it has ended.
    int source() const { return source_; }
    /// The end of a pipe that a child is to read.
    process::FileDescriptor add_receiver();
    /// After poll(): does not wait. A receiver that does not read loses what its pipe does not hold.
    void forward();

  private:
    int source_;
    std::vector<process::FileDescriptor> receivers_;
};

} // namespace tandem::hosts
