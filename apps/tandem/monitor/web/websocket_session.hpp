// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/responses.hpp"
#include "apps/tandem/monitor/web/service.hpp"

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include <chrono>
#include <deque>
#include <memory>
#include <string>

namespace tandem::monitor {

/// One WebSocket: the handshake, what is read, and a queue of what is sent. It lives as long as an operation of it is under way.
/// A client that takes more than 5 s for the handshake, does not answer a ping for `idle`, or sends a message of more than
/// `max_message` bytes is disconnected. [one thread]
class WebSocketSession : public std::enable_shared_from_this<WebSocketSession> {
  public:
    virtual ~WebSocketSession() = default;
    /// Answers the request with the upgrade.
    void run(Request request);

  protected:
    WebSocketSession(boost::beast::tcp_stream stream, Place place, std::chrono::seconds idle,
                     std::size_t max_message);
    /// In the constructor, if the session speaks one.
    void set_subprotocol(const char* name);

    virtual void on_open(const Request& request) = 0;
    virtual void on_message(const std::string& bytes, bool binary) = 0;
    /// All that was queued has been sent.
    virtual void on_sent() {}
    /// The connection is closed; called again if it is closed again.
    virtual void on_close() {}

    void send(std::shared_ptr<const std::string> bytes, bool binary = false);
    std::size_t queued_messages() const { return queue_.size(); } ///< the one that is being sent included
    std::size_t queued_bytes() const { return queued_bytes_; }
    void close(); ///< ends the operations that are under way

  private:
    struct Outgoing {
        std::shared_ptr<const std::string> bytes;
        bool binary;
    };

    void read();
    void write();

    boost::beast::websocket::stream<boost::beast::tcp_stream, false> stream_; ///< false: it never compresses
    Place place_;
    Request request_;
    boost::beast::flat_buffer received_;
    std::deque<Outgoing> queue_; ///< the first is being sent
    std::size_t queued_bytes_ = 0;
};

} // namespace tandem::monitor
