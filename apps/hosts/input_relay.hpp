// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/hosts/user_terminal.hpp"
#include "host/process/file_descriptor.hpp"

#include <memory>
#include <poll.h>
#include <string>
#include <vector>

namespace tandem::hosts {

/// Copies the input of a descriptor to several child processes, each of which gets all of it. If the descriptor is
/// a terminal, each child gets a terminal too, so that it can read single keys. They are in separate process
/// groups, so the user's terminal would stop them if they read it.
class InputRelay {
  public:
    /// Ignores SIGTTIN from here on, because this program may run in the background.
    explicit InputRelay(int source);

    /// The input of a new child process: a pipe, or the name of its terminal. The descriptor must stay open until
    /// the process has been started.
    struct Input {
        process::FileDescriptor descriptor;
        std::string terminal{};
    };
    Input add_receiver();
    /// Adds the descriptors for which forward() should be called.
    void add_events(std::vector<pollfd>& events);
    /// Forwards available input, and shows what the children's terminals echo, without waiting. A receiver that does
    /// not read loses input when its pipe or terminal is full.
    void forward();
    /// Gives the user's terminal back until the next forward().
    void release_terminal();
    /// Ends the input of all receivers: a child that waits for a key continues.
    void end();

  private:
    /// This program's end of a pipe or terminal.
    struct Receiver {
        process::FileDescriptor descriptor;
        bool is_closed = false; ///< the child has no descriptor of its terminal now
    };
    Input add_terminal();
    void update_terminals();
    void send(const char* text, std::size_t size);

    int source_;                             ///< -1 after its end
    std::unique_ptr<UserTerminal> terminal_; ///< null if the source is not a terminal
    std::vector<Receiver> receivers_;
};

} // namespace tandem::hosts
