// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/child_process.hpp"

#include <vector>

namespace tandem::hosts {

/// Copies the input of a descriptor, usually the terminal, to several child processes. They are in separate
/// process groups, so the terminal would stop them if they read it. Each child gets all input, up to the
/// end of the source.
class InputRelay {
  public:
    /// Ignores SIGTTIN from here on, because this program may run in the background.
    explicit InputRelay(int source);

    /// Returns the descriptor for poll(); -1 after its end.
    int source() const { return source_; }
    /// Returns the end of a pipe for a child to read.
    process::FileDescriptor add_receiver();
    /// Forwards available input without waiting. Call it after poll(). A receiver that does not read loses
    /// input when its pipe is full.
    void forward();

  private:
    int source_;
    std::vector<process::FileDescriptor> receivers_;
};

} // namespace tandem::hosts
