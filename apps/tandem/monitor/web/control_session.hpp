// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/responses.hpp"
#include "apps/tandem/monitor/web/service.hpp"

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include <deque>
#include <memory>
#include <string>

namespace tandem::monitor {

/// A client that may control: it shows the token first, then each of its messages is a request of Control. [one thread]
class ControlSession : public std::enable_shared_from_this<ControlSession> {
  public:
    static constexpr std::size_t max_message = 8 << 10; ///< bytes of a request
    static constexpr std::size_t max_waiting = 32;      ///< replies that a client may be behind

    ControlSession(boost::beast::tcp_stream stream, Service& service, Place place);
    /// Answers the request with the upgrade.
    void run(Request request);

  private:
    void read();
    void on_message(const std::string& text);
    void send(std::string text);
    void write();
    void close();

    boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
    Service& service_;
    Place place_;
    Request request_;
    boost::beast::flat_buffer received_{max_message};
    std::deque<std::string> replies_; ///< the first is being sent
    bool trusted_ = false;            ///< has shown the token
};

} // namespace tandem::monitor
