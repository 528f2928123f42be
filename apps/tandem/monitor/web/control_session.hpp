// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/websocket_session.hpp"

#include <string>

namespace tandem::monitor {

/// A client that may control: it shows the token first, then each of its messages is a request of Control. [one thread]
class ControlSession final : public WebSocketSession {
  public:
    static constexpr std::size_t max_message = 8 << 10; ///< bytes of a request
    static constexpr std::size_t max_waiting = 32;      ///< replies that a client may be behind

    ControlSession(boost::beast::tcp_stream stream, Service& service, Place place);

  private:
    void on_open(const Request&) override {}
    void on_message(const std::string& text, bool binary) override;
    void reply(std::string text);

    Service& service_;
    bool trusted_ = false; ///< has shown the token
};

} // namespace tandem::monitor
