// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/websocket_session.hpp"

#include <memory>
#include <string>

namespace tandem::monitor {

/// A page that gets each new state. While one is being sent, only the newest of those that follow is kept. What the client
/// sends is ignored. [one thread]
class PageSession final : public WebSocketSession {
  public:
    static constexpr std::size_t max_message = 1024; ///< bytes that a client may send at once
    /// States that a client may be behind before its connection is closed: 12 s of them.
    static constexpr int max_skipped = 60;

    PageSession(boost::beast::tcp_stream stream, Service& service, Place place);
    ~PageSession() override { service_.live.erase(this); }
    void send_state(std::shared_ptr<const std::string> state);

  private:
    void on_open(const Request& request) override;
    void on_message(const std::string&, bool) override {}
    void on_sent() override;
    void on_close() override { service_.live.erase(this); }

    Service& service_;
    std::shared_ptr<const std::string> next_; ///< null: none
    int skipped_ = 0;                         ///< since the last state that was sent
};

} // namespace tandem::monitor
