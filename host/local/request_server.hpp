// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace tandem::local {

/// What a RequestServer does with a request. No function may throw.
struct RequestHandler {
    /// Returns the reply. May take any time, even forever. [a thread for each request]
    std::function<std::string(const std::string& request)> answer;
    /// Returns after which time late_reply() is sent instead. [server-thread]
    std::function<std::chrono::milliseconds(const std::string& request)> time_limit;
    /// Returns the reply to a request whose answer() has not returned in time. [server-thread]
    std::function<std::string(const std::string& request)> late_reply;
    /// Returns whether answer() may take long. Such requests leave four places to others. [server-thread]
    std::function<bool(const std::string& request)> may_hang;
    /// The reply when too many requests are still running.
    std::string refusal;
};

/// Answers requests of processes of this user, and of root, at a Unix socket. One thread sleeps in poll() without a
/// timer while nobody asks. A client sends one request per connection. The number of clients, the size of requests
/// and replies, and the time to send and to receive them are bounded.
class RequestServer {
  public:
    /// Listens on return. Throws std::runtime_error, one line, if there can be no socket or thread. [main-thread]
    RequestServer(const std::filesystem::path& socket, RequestHandler handler);
    /// stop_within(0).
    ~RequestServer();
    RequestServer(const RequestServer&) = delete;
    RequestServer& operator=(const RequestServer&) = delete;

    /// Removes the socket, closes the connections and waits for the requests that are still running. Then destroys the handler.
    /// Returns false if a request still runs: what its handler uses must then live as long as the process. [main-thread]
    bool stop_within(std::chrono::nanoseconds timeout);

  private:
    struct State;
    std::shared_ptr<State> state_; ///< shared with the threads, which may outlive this object
};

} // namespace tandem::local
