// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/websocket_session.hpp"

#include <string>

namespace tandem::monitor {

/// A client of the control. It first sends the token; each further message is a request of Control. [one thread]
class ControlSession final : public WebSocketSession {
  public:
    static constexpr std::size_t max_message = 8 << 10; ///< bytes of a request
    static constexpr std::size_t max_waiting = 32;      ///< limit for unsent replies

    ControlSession(boost::beast::tcp_stream stream, Service& service, Place place);

  private:
    void on_open(const Request&) override {}
    void on_message(const std::string& text, bool binary) override;
    void reply(std::string text);

    Service& service_;
    bool trusted_ = false; ///< the client has sent the token
};

} // namespace tandem::monitor
