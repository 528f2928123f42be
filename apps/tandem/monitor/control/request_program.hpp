// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/rtm/requests/frame.hpp"
#include "host/process/child_process.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/steady_timer.hpp>

#include <array>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace tandem::monitor {

/// Runs `tandem rtm requests`, so that slow CORBA requests do not block the server. The first request starts the
/// program, and starts it again after its end. The program executes one request at a time. [one thread]
class RequestProgram {
  public:
    static constexpr std::size_t max_waiting = 4 << 20; ///< bytes of unsent requests
    static constexpr std::size_t max_pending = 64;      ///< unanswered requests
    static constexpr std::chrono::seconds max_time{30}; ///< limit for an answer; then the program is killed

    using Done = std::function<void(const command::Frame& reply)>;
    /// `ended`: the publisher no longer exists.
    using Failed = std::function<void(const std::string& text, bool ended)>;

    /// `program`: path of tandem. `call_timeout_s`: limit for each CORBA call.
    RequestProgram(boost::asio::io_context& context, std::string program, std::string call_timeout_s);
    ~RequestProgram();

    /// Sends a request. Calls `done` once, now or later, with `ok` and `text`.
    void ask(command::Frame request, Done done);
    /// Sends a message, which is answered only on failure: by calling `failed` of add_publisher(). Returns false,
    /// without sending, if the queue is full.
    bool tell(const command::Frame& request);

    /// Returns a number for requests `open`, `send` and `close`. `failed` reports a rejected message or the
    /// connection's end.
    int add_publisher(Failed failed);
    void remove_publisher(int publisher);

  private:
    struct Pending {
        std::chrono::steady_clock::time_point end;
        Done done;
    };
    struct Connection; ///< the program and the socket to it

    void start();
    bool send(const command::Frame& frame);
    void write();
    void read();
    void take(const command::Frame& reply);
    void end(const std::string& why);
    void watch();

    boost::asio::io_context& context_;
    const std::string program_, call_timeout_s_;
    boost::asio::steady_timer timer_;
    bool watches_ = false;
    std::shared_ptr<Connection> connection_; ///< null: not running
    int next_id_ = 1, next_publisher_ = 1;
    std::map<int, Pending> pending_;
    std::map<int, Failed> publishers_;
};

} // namespace tandem::monitor
