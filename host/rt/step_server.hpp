// SPDX-License-Identifier: Apache-2.0
// Lock-step: cycles run when a conductor asks for them, one at a time, instead of on timers.
// Protocol on a unix stream socket (mode 0600): request line `step NAME`, reply line `ok` or `error TEXT`.
#pragma once

#include "host/rt/line_socket.hpp"

#include <functional>
#include <list>
#include <string>
#include <thread>

namespace tandem::rt {

class StepServer {
  public:
    /// Runs one cycle of the named component; throws std::exception for an error reply.
    using Step = std::function<void(const std::string& component)>;

    /// Listens at once; `step` runs in the server's own thread. Throws std::runtime_error when the socket
    /// cannot be made or another process listens on it; a socket file left by a dead one is replaced.
    StepServer(const std::string& socket_path, Step step);
    /// Waits for the cycle under way, if any, and removes the socket file.
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
    FileDescriptor listener_, stop_;
    std::list<Client> clients_;
    std::thread thread_;
};

} // namespace tandem::rt
