// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/places.hpp"
#include "apps/tandem/monitor/web/responses.hpp"
#include "apps/tandem/monitor/web/service.hpp"

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include <chrono>
#include <deque>
#include <memory>
#include <string>

namespace tandem::monitor {

/// One WebSocket: handshake, reading, and a queue for sending. Pending operations keep it alive. Disconnects a client
/// that takes more than 5 s for the handshake, does not answer a ping for `idle`, or sends more than `max_message`
/// bytes in a message. [one thread]
class WebSocketSession : public std::enable_shared_from_this<WebSocketSession> {
  public:
    virtual ~WebSocketSession() = default;
    /// Accepts the upgrade request.
    void run(Request request);

  protected:
    WebSocketSession(boost::beast::tcp_stream stream, Place place, std::chrono::seconds idle,
                     std::size_t max_message);
    /// Call this in the constructor if the session uses a subprotocol.
    void set_subprotocol(const char* name);

    virtual void on_open(const Request& request) = 0;
    virtual void on_message(const std::string& bytes, bool binary) = 0;
    /// Called when the queue has been sent.
    virtual void on_sent() {}
    /// Called when the connection is closed; may be called repeatedly.
    virtual void on_close() {}

    void send(std::shared_ptr<const std::string> bytes, bool binary = false);
    std::size_t queued_messages() const { return queue_.size(); } ///< includes the one being sent
    std::size_t queued_bytes() const { return queued_texts_ + queued_binaries_; }
    std::size_t queued_bytes(bool binary) const { return binary ? queued_binaries_ : queued_texts_; }
    void close(); ///< ends the pending operations

  private:
    struct Outgoing {
        std::shared_ptr<const std::string> bytes;
        bool binary;
    };

    void read();
    void write();

    boost::beast::websocket::stream<boost::beast::tcp_stream, false> stream_; ///< false: no compression
    Place place_;
    Request request_;
    boost::beast::flat_buffer received_;
    std::deque<Outgoing> queue_;                         ///< the first is being sent
    std::size_t queued_texts_ = 0, queued_binaries_ = 0; ///< bytes
};

} // namespace tandem::monitor
