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

/// `tandem rtm requests`, started with the first request, and again when it has ended: what by CORBA may take long, beside the
/// server, which does not wait. Requests are carried out one after the other. [one thread]
class RequestProgram {
  public:
    static constexpr std::size_t max_waiting = 4 << 20; ///< bytes of requests that it has not taken yet
    static constexpr std::size_t max_pending = 64;      ///< requests that are not answered yet
    static constexpr std::chrono::seconds max_time{30}; ///< for an answer; then the program is ended

    using Done = std::function<void(const command::Frame& reply)>;
    /// `ended`: the publisher is none any more.
    using Failed = std::function<void(const std::string& text, bool ended)>;

    /// `program`: path of tandem. `call_timeout_s`: of each call by CORBA.
    RequestProgram(boost::asio::io_context& context, std::string program, std::string call_timeout_s);
    ~RequestProgram();

    /// `done` is called once, later or at once, with `ok` and `text`.
    void ask(command::Frame request, Done done);
    /// Sends a message, which is answered only if it fails: then `failed` of add_publisher() is called. Returns false, and
    /// sends nothing, if there is no room.
    bool tell(const command::Frame& request);

    /// A number for requests `open`, `send` and `close`. `failed`: a message was not taken, or the connection has ended.
    int add_publisher(Failed failed);
    void remove_publisher(int publisher);

  private:
    struct Pending {
        std::chrono::steady_clock::time_point end;
        Done done;
    };
    struct Connection; ///< the program and its end of the socket

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
    std::shared_ptr<Connection> connection_; ///< null: not started, or ended
    int next_id_ = 1, next_publisher_ = 1;
    std::map<int, Pending> pending_;
    std::map<int, Failed> publishers_;
};

} // namespace tandem::monitor
