// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/responses.hpp"
#include "apps/tandem/monitor/web/service.hpp"

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include <memory>
#include <string>

namespace tandem::monitor {

/// A page that gets each new state. While one is being sent, only the newest of those that follow is kept. What the client
/// sends is ignored. [one thread]
class WebSocketSession : public std::enable_shared_from_this<WebSocketSession> {
  public:
    static constexpr std::size_t max_message = 1024; ///< bytes that a client may send at once
    /// States that a client may be behind before its connection is closed: 12 s of them.
    static constexpr int max_skipped = 60;

    WebSocketSession(boost::beast::tcp_stream stream, Service& service, Place place);
    ~WebSocketSession();
    /// Answers the request with the upgrade, and sends the newest state.
    void run(Request request);
    void send(std::shared_ptr<const std::string> state);

  private:
    void on_accept(boost::beast::error_code failure);
    void read();
    void write();
    void on_write(boost::beast::error_code failure);

    boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
    Service& service_;
    Place place_;
    Request request_;
    boost::beast::flat_buffer received_{max_message};
    std::shared_ptr<const std::string> sending_, next_; ///< null: none
    int skipped_ = 0;                                   ///< since the last state that was sent
};

} // namespace tandem::monitor
