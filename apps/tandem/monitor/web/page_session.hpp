// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/websocket_session.hpp"

#include <memory>
#include <string>

namespace tandem::monitor {

/// A page that receives each new state. While one state is being sent, only the newest next state is kept. Ignores
/// messages of the client. [one thread]
class PageSession final : public WebSocketSession {
  public:
    static constexpr std::size_t max_message = 1024; ///< limit in bytes for a client's message
    /// Number of skipped states until a slow client is disconnected; equal to 12 s.
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
    int skipped_ = 0;                         ///< since the last sent state
};

} // namespace tandem::monitor
