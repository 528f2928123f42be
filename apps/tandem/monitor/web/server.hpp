// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/service.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include <cstdint>
#include <string>

namespace tandem::monitor {

/// Accepts connections and starts a session for each. The service's pools bound them. [one thread]
class Server {
  public:
    /// Starts to listen. Throws std::runtime_error with one line if the address is invalid or not on this machine, or
    /// if the port is in use. `service` must outlive the context's handlers.
    Server(boost::asio::io_context& context, const std::string& address, std::uint16_t port,
           Service& service);
    /// Sends the service's newest state to all WebSockets.
    void publish();
    std::string url() const; ///< of the page, for a browser on this machine

  private:
    void accept();
    void serve(boost::asio::ip::tcp::socket socket);

    boost::asio::ip::tcp::acceptor acceptor_;
    boost::asio::steady_timer retry_;
    Service& service_;
};

} // namespace tandem::monitor
