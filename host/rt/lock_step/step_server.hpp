// SPDX-License-Identifier: Apache-2.0
// Lock-step: instead of timers, a client runs the components, one cycle at a time, in an order that the client chooses.
// This makes a run reproducible. The protocol uses a unix stream socket (mode 0600). A request is a line `step NAME`;
// its reply is a line `ok` or `error TEXT`.
#pragma once

#include "host/rt/lock_step/line_socket.hpp"

#include <functional>
#include <list>
#include <string>
#include <thread>

namespace tandem::rt {

/// Serves any number of clients in one separate thread, so no two cycles ever run at the same time.
class StepServer {
  public:
    /// Runs one cycle of the named component. Throws std::exception for an error reply.
    using Step = std::function<void(const std::string& component)>;

    /// Listens on return and calls `step` in the server's thread. Replaces a socket file that a dead process has left.
    /// Throws std::runtime_error if the socket cannot be created or another process listens on it.
    StepServer(const std::string& socket_path, Step step);
    /// Waits for the current cycle, if any, without a time limit, and removes the socket file.
    ~StepServer();
    StepServer(const StepServer&) = delete;
    StepServer& operator=(const StepServer&) = delete;

  private:
    struct Client {
        FileDescriptor socket;
        LineBuffer lines;
    };
    void serve();
    bool wait_for_input();
    void accept_one();
    bool answer(Client& client);
    std::string reply_to(const std::string& request);

    std::string path_;
    Step step_;
    FileDescriptor listener_, stop_; // stop_ is an eventfd that ends the thread
    std::list<Client> clients_;
    std::thread thread_;
};

} // namespace tandem::rt
